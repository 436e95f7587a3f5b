#include "daylight/sun_hours.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace gnomon::daylight {

namespace {

void add(const std::vector<std::uint8_t>& isLit, std::uint32_t step, LitSteps& result) {
    constexpr std::size_t kGrain = 65536;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, isLit.size(), kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            if (isLit[i] == 0) continue;
            if (result.count[i]++ == 0) result.first[i] = step;
            result.last[i] = step;
        }
    });
}

} // namespace

std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps) {
    std::vector<IntegerLight> lights;
    for (const SunStep& step : steps)
        if (step.isUp) lights.push_back(step.light);
    return lights;
}

LitSteps litSteps(Receivers& receivers, const std::vector<SunStep>& steps, LitLog& log, Progress& progress) {
    LitSteps result;
    result.count.assign(receivers.count(), 0);
    result.first.assign(receivers.count(), LitSteps::kNever);
    result.last.assign(receivers.count(), LitSteps::kNever);
    std::vector<std::uint8_t> isLit(receivers.count());
    progress.stage("sun", "directions", lightsOf(steps).size());
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (!steps[i].isUp) continue;
        if (result.stepsUp < log.size()) {
            log.read(result.stepsUp, isLit);
        } else {
            const exact::ExactStatistics statistics = receivers.decide(steps[i].light, isLit);
            result.samples += statistics.samples;
            result.touching += statistics.touching;
            log.add(isLit);
        }
        ++result.stepsUp;
        add(isLit, static_cast<std::uint32_t>(i), result);
        progress.advance(1);
    }
    return result;
}

} // namespace gnomon::daylight
