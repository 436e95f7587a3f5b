// The processes that count hours of sun together: this one alone, or all ranks of an MPI job (src/mpi).
#pragma once

#include "core/progress.h"
#include "daylight/sun_hours.h"

#include <string>

namespace gnomon::measure {

/// This process alone. A job overrides all functions.
class SunHoursTeam {
public:
    SunHoursTeam() = default;
    virtual ~SunHoursTeam() = default;
    SunHoursTeam(const SunHoursTeam&) = delete;
    SunHoursTeam& operator=(const SunHoursTeam&) = delete;
    SunHoursTeam(SunHoursTeam&&) = delete;
    SunHoursTeam& operator=(SunHoursTeam&&) = delete;

    /// Which lights this process decides. Rank 0 writes the files and tells the user; all others write and tell
    /// nothing.
    virtual daylight::LightShare share() const { return {}; }

    bool leads() const { return share().rank == 0; }

    /// Waits until all ranks are ready to decide. Throws Error if one has another `key`.
    virtual void begin(const std::string& /*key*/, Progress& /*progress*/) {}

    /// Throws Error if another rank failed, and Interrupted if rank 0 ended the job.
    virtual void poll() {}

    /// Waits for all ranks and adds their results. `lit` is complete in rank 0 only.
    virtual void combine(daylight::LitSteps& /*lit*/, Progress& /*progress*/) {}
};

} // namespace gnomon::measure
