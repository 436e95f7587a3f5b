// Hours of sun: of each receiver in how many steps the Sun reaches it, when first and when last.
#pragma once

#include "core/process/task_farm.h"
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

/// How a process decides `receivers` for another, light by light.
FarmWork workOf(Receivers& receivers, const std::vector<SunStep>& steps);

/// Decides `receivers` for all steps whose lights `log` lacks, in all processes of `farm`, and adds what each light
/// comes to to the log. `progress` advances by one for each light, those of the log included; where it throws, the log
/// holds what was done.
LitSteps litSteps(
    Receivers& receivers, const std::vector<SunStep>& steps, LitLog& log, TaskFarm& farm, Progress& progress);

} // namespace gnomon::daylight
