// The times of the last frames per stage, for the graph and for readable medians.
#pragma once

#include "telemetry/frame_row.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::viewer {

/// The stages of a frame in the order of the graph. The last stage is the window: overlay and presentation.
inline constexpr std::array kStageNames = {"plan", "select", "cull", "stream", "shadow", "image", "window"};
constexpr std::size_t kStages = kStageNames.size();

/// Milliseconds per stage.
using StageTimes = std::array<double, kStages>;

/// Returns the stage times of a log row, with the time of the window.
StageTimes stageTimes(const telemetry::FrameRow& row, double windowMs);

/// Returns the sum over the stages.
double total(const StageTimes& times);

/// A ring of the last `capacity` frames.
class FrameHistory {
public:
    explicit FrameHistory(std::size_t capacity) : capacity_(capacity) {}

    void add(const StageTimes& times);

    /// Returns the frames, oldest first.
    std::span<const StageTimes> frames() const { return frames_; }

    /// Returns the median of each stage over the last `count` frames, or zero if there are no frames.
    StageTimes medians(std::size_t count) const;

private:
    std::size_t capacity_;
    std::vector<StageTimes> frames_;
};

} // namespace gnomon::viewer
