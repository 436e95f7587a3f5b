#include "viewer/panel/frame_history.h"

#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <numeric>

namespace gnomon::viewer {

StageTimes stageTimes(const telemetry::FrameRow& row, double windowMs) {
    return {
        row.planMs.value_or(0),
        row.selectMs.value_or(0),
        row.cullMs.value_or(0),
        row.streamMs.value_or(0),
        row.shadowMs.value_or(0),
        row.imageMs.value_or(0),
        windowMs};
}

double total(const StageTimes& times) {
    return std::accumulate(times.begin(), times.end(), 0.0);
}

void FrameHistory::add(const StageTimes& times) {
    if (frames_.size() == capacity_) frames_.erase(frames_.begin());
    frames_.push_back(times);
}

StageTimes FrameHistory::medians(std::size_t count) const {
    StageTimes result{};
    const std::size_t used = std::min(count, frames_.size());
    if (used == 0) return result;
    for (std::size_t stage = 0; stage < kStages; ++stage) {
        std::vector<double> values;
        for (std::size_t i = frames_.size() - used; i < frames_.size(); ++i)
            values.push_back(frames_[i][stage]);
        result[stage] = telemetry::quantile(values, 0.5);
    }
    return result;
}

} // namespace gnomon::viewer
