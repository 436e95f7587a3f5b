#include "sun/sun_hours.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::sun {

namespace {

/// Adds the receivers (tested points) that are lit in the time step `step` to the result. Steps can be added in any
/// order.
void add(const std::vector<std::uint8_t>& isLit, std::uint32_t step, LitSteps& result) {
    constexpr std::size_t kGrain = 65536;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, isLit.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (isLit[i] == 0) continue;
            const bool isFirst = result.count[i]++ == 0;
            result.first[i] = isFirst ? step : std::min(result.first[i], step);
            result.last[i] = isFirst ? step : std::max(result.last[i], step);
        }
    });
}

/// Returns the indices of the time steps in which the Sun is above the horizon.
std::vector<std::uint32_t> stepsOfLights(const std::vector<SunStep>& steps) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < steps.size(); ++i)
        if (steps[i].isUp) places.push_back(i);
    return places;
}

} // namespace

std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps) {
    std::vector<IntegerLight> lights;
    for (const SunStep& step : steps)
        if (step.isUp) lights.push_back(step.light);
    return lights;
}

LitSteps litSteps(
    Receivers& receivers,
    const std::vector<SunStep>& steps,
    LitLogs& logs,
    const LightShare& share,
    Progress& progress) {
    const std::vector<std::uint32_t> stepOf = stepsOfLights(steps);
    LitSteps result;
    result.count.assign(receivers.count(), 0);
    result.first.assign(receivers.count(), LitSteps::kNever);
    result.last.assign(receivers.count(), LitSteps::kNever);
    result.stepsUp = static_cast<std::uint32_t>(stepOf.size());
    std::vector<std::uint8_t> isLit(receivers.count());
    progress.stage("sun", "directions", (stepOf.size() + share.ranks - 1 - share.rank) / share.ranks);
    for (std::size_t light = 0; light < stepOf.size(); ++light) {
        if (!share.owns(light)) continue;
        if (!logs.read(light, isLit)) {
            const exact::ExactStatistics statistics = receivers.resolve(steps[stepOf[light]].light, isLit);
            result.samples += statistics.samples;
            result.withinTolerance += statistics.withinTolerance;
            logs.put(light, isLit);
        }
        add(isLit, stepOf[light], result);
        progress.advance(1);
    }
    return result;
}

} // namespace gnomon::sun
