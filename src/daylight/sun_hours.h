// Hours of sun: of each receiver in how many steps the Sun reaches it, when first and when last.
#pragma once

#include "core/progress.h"
#include "daylight/lit_log.h"
#include "daylight/receivers.h"
#include "daylight/sun_steps.h"

#include <limits>
#include <vector>

namespace gnomon::daylight {

/// What came of a period, by receiver: whole numbers, so that neither order nor threads matter.
struct LitSteps {
    static constexpr std::uint32_t kNever = std::numeric_limits<std::uint32_t>::max();

    std::vector<std::uint32_t> count; // steps in which the Sun reaches it
    std::vector<std::uint32_t> first; // the first and the last of these, by their place among the period's steps
    std::vector<std::uint32_t> last;
    std::uint32_t stepsUp = 0;  // in which the Sun is up
    std::uint64_t samples = 0;  // receivers that faced the Sun, summed over the steps that were decided now
    std::uint64_t touching = 0; // of these, whose verdict hangs on the tolerance or on the rule for ties
};

/// The lights of those steps in which the Sun is up.
std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps);

/// Decides `receivers` for the lights of `share`, but for those that `logs` has, and adds each decided light to the
/// logs. The result counts the lights of `share` only. `progress` advances by one for each of them. If it
/// throws, the logs hold what was done.
LitSteps litSteps(
    Receivers& receivers,
    const std::vector<SunStep>& steps,
    LitLogs& logs,
    const LightShare& share,
    Progress& progress);

} // namespace gnomon::daylight
