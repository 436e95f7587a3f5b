// The processes that compute sun hours together: this process alone, or all ranks of an MPI job (src/mpi).
#pragma once

#include "core/progress.h"
#include "sun/sun_hours.h"

#include <string>

namespace gnomon::task {

/// A team that contains only this process. The team of an MPI job overrides all virtual functions.
class SunHoursTeam {
public:
    SunHoursTeam() = default;
    virtual ~SunHoursTeam() = default;
    SunHoursTeam(const SunHoursTeam&) = delete;
    SunHoursTeam& operator=(const SunHoursTeam&) = delete;
    SunHoursTeam(SunHoursTeam&&) = delete;
    SunHoursTeam& operator=(SunHoursTeam&&) = delete;

    /// Returns which light directions this process computes. Only rank 0 writes files and messages.
    virtual sun::LightShare share() const { return {}; }

    /// Returns true in rank 0.
    bool leads() const { return share().rank == 0; }

    /// Waits until all processes of the job are ready to compute. Throws Error if one has another `key`, which
    /// identifies the model, the lights and the receivers.
    virtual void begin(const std::string& /*key*/, Progress& /*progress*/) {}

    /// Throws Error if another rank has failed, and Interrupted if rank 0 has ended the job. Called after each light
    /// direction.
    virtual void poll() {}

    /// Waits for all ranks and adds their sun hours to `lit`. The result is complete in rank 0 only.
    virtual void combine(sun::LitSteps& /*lit*/, Progress& /*progress*/) {}
};

} // namespace gnomon::task
