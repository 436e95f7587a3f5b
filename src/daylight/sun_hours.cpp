#include "daylight/sun_hours.h"

#include "hierarchy/bytes.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::daylight {

namespace {

/// Counts a step in. Steps come in any order.
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

/// The places of those steps in which the Sun is up.
std::vector<std::uint32_t> stepsOfLights(const std::vector<SunStep>& steps) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < steps.size(); ++i)
        if (steps[i].isUp) places.push_back(i);
    return places;
}

TaskBytes encodedLight(std::size_t light) {
    hierarchy::ByteWriter out;
    out.putVarint(light);
    return out.take();
}

/// What came of a light: a bit for each receiver.
TaskBytes encodedVerdict(const exact::ExactStatistics& statistics, const std::vector<std::uint8_t>& isLit) {
    hierarchy::ByteWriter out;
    out.putVarint(statistics.samples);
    out.putVarint(statistics.touching);
    for (std::size_t i = 0; i < isLit.size(); i += 8) {
        unsigned bits = 0;
        for (std::size_t k = i; k < std::min(i + 8, isLit.size()); ++k)
            bits |= (isLit[k] != 0 ? 1U : 0U) << (k - i);
        out.put(static_cast<std::uint8_t>(bits));
    }
    return out.take();
}

void takeVerdict(std::span<const std::byte> bytes, LitSteps& sums, std::vector<std::uint8_t>& isLit) {
    hierarchy::ByteReader in(bytes);
    sums.samples += in.takeVarint();
    sums.touching += in.takeVarint();
    const std::span<const std::byte> bits = in.take((isLit.size() + 7) / 8);
    in.expectEnd();
    for (std::size_t i = 0; i < isLit.size(); ++i)
        isLit[i] = static_cast<std::uint8_t>(std::to_integer<unsigned>(bits[i / 8]) >> i % 8 & 1U);
}

} // namespace

std::vector<IntegerLight> lightsOf(const std::vector<SunStep>& steps) {
    std::vector<IntegerLight> lights;
    for (const SunStep& step : steps)
        if (step.isUp) lights.push_back(step.light);
    return lights;
}

FarmWork workOf(Receivers& receivers, const std::vector<SunStep>& steps) {
    return {
        [&receivers,
         lights = lightsOf(steps)](std::span<const std::byte> input, Progress& /*progress*/, const auto& /*tell*/) {
            hierarchy::ByteReader in(input);
            std::vector<std::uint8_t> isLit(receivers.count());
            const exact::ExactStatistics statistics = receivers.decide(lights.at(in.takeVarint()), isLit);
            return encodedVerdict(statistics, isLit);
        },
        FarmWork::Thread::Another};
}

LitSteps litSteps(
    Receivers& receivers, const std::vector<SunStep>& steps, LitLog& log, TaskFarm& farm, Progress& progress) {
    const std::vector<std::uint32_t> stepOf = stepsOfLights(steps);
    LitSteps result;
    result.count.assign(receivers.count(), 0);
    result.first.assign(receivers.count(), LitSteps::kNever);
    result.last.assign(receivers.count(), LitSteps::kNever);
    result.stepsUp = static_cast<std::uint32_t>(stepOf.size());
    std::vector<std::uint8_t> isLit(receivers.count());
    progress.stage("sun", "directions", stepOf.size());
    std::vector<std::size_t> missing;
    for (std::size_t light = 0; light < stepOf.size(); ++light) {
        if (!log.has(light)) {
            missing.push_back(light);
            continue;
        }
        log.read(light, isLit);
        add(isLit, stepOf[light], result);
        progress.advance(1);
    }
    FarmTasks tasks;
    tasks.name = "sun";
    tasks.count = missing.size();
    tasks.input = [&](std::size_t task) { return encodedLight(missing[task]); };
    tasks.take = [&](std::size_t task, std::span<const std::byte> bytes) {
        takeVerdict(bytes, result, isLit);
        log.put(missing[task], isLit);
        add(isLit, stepOf[missing[task]], result);
        progress.advance(1);
    };
    farm.run(tasks, workOf(receivers, steps), progress);
    return result;
}

} // namespace gnomon::daylight
