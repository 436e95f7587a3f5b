// Computes sun hours. They are the number of time steps in which the Sun reaches each receiver (a tested point of a
// model), with the first and the last of these steps.
#pragma once

#include "core/progress.h"
#include "sun/lit_log.h"
#include "sun/receivers.h"
#include "sun/sun_steps.h"

#include <limits>
#include <vector>

namespace gnomon::sun {

/// The sun hours of each receiver (a tested point) over a period, in time steps. The values are integers, so they do
/// not depend on the order of the lights or on threads.
struct LitSteps {
    static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> count; // number of steps with sunlight
    std::vector<std::uint32_t> first; // index of the first and of the last such step in the period
    std::vector<std::uint32_t> last;
    std::uint32_t stepsUp = 0;         // steps in which the Sun is up
    std::uint64_t samples = 0;         // receivers that faced the Sun, summed over the steps that this run computed
    std::uint64_t withinTolerance = 0; // samples whose result depends on the tolerance or on the rule for ties
};

/// Returns the light direction of each time step in which the Sun is above the horizon.
std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps);

/// Tests which of `receivers` are lit from the light directions of `share`, and returns the number of lit time steps
/// per receiver. Skips lights that `logs` already contains, and adds each computed light to the logs. The result covers
/// only the lights of `share`. `progress` advances by one per light. If the function throws, the logs contain the
/// lights that are computed so far.
LitSteps litSteps(
    Receivers& receivers,
    const std::vector<SunStep>& steps,
    LitLogs& logs,
    const LightShare& share,
    Progress& progress);

} // namespace gnomon::sun
