// Sun hours: the number of steps in which the Sun reaches each receiver, with the first and the last step.
#pragma once

#include "core/progress.h"
#include "sun/lit_log.h"
#include "sun/receivers.h"
#include "sun/sun_steps.h"

#include <limits>
#include <vector>

namespace gnomon::sun {

/// The result of a period, by receiver. The values are integers, so they do not depend on order or threads.
struct LitSteps {
    static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> count; // number of steps with sunlight
    std::vector<std::uint32_t> first; // index of the first and of the last such step in the period
    std::vector<std::uint32_t> last;
    std::uint32_t stepsUp = 0;         // steps in which the Sun is up
    std::uint64_t samples = 0;         // receivers that faced the Sun, summed over the steps that this run computed
    std::uint64_t withinTolerance = 0; // samples whose result depends on the tolerance or on the rule for ties
};

/// Returns the light directions of all steps in which the Sun is up.
std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps);

/// Tests `receivers` against the light directions of `share`. Skips lights that `logs` already contains, and adds each
/// computed light to the logs. The result covers only the lights of `share`. `progress` advances by one per light. If
/// the function throws, the logs contain the computed lights.
LitSteps litSteps(
    Receivers& receivers,
    const std::vector<SunStep>& steps,
    LitLogs& logs,
    const LightShare& share,
    Progress& progress);

} // namespace gnomon::sun
