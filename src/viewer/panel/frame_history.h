// Stores the times of the last frames per stage, for the graph and the medians that the window shows.
#pragma once

#include "telemetry/frame_row.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::viewer {

/// The stages of a frame in the order in which the graph stacks them. The last stage, "window", is the drawing of the
/// overlay and the presentation.
inline constexpr std::array kStageNames = {"plan", "select", "cull", "stream", "shadow", "image", "window"};
constexpr std::size_t kStages = kStageNames.size();

/// The time of each stage of a frame, in milliseconds.
using StageTimes = std::array<double, kStages>;

/// Returns the time of each stage from a log row of a frame and the time `windowMs` of the window stage.
StageTimes stageTimes(const telemetry::FrameRow& row, double windowMs);

/// Returns the total time of a frame, the sum over its stages, in milliseconds.
double total(const StageTimes& times);

/// A buffer of the stage times of the last `capacity` frames.
class FrameHistory {
public:
    explicit FrameHistory(std::size_t capacity) : capacity_(capacity) {}

    void add(const StageTimes& times);

    /// Returns the stage times of the stored frames, oldest first.
    std::span<const StageTimes> frames() const { return frames_; }

    /// Returns the median time of each stage over the last `count` frames, or zero if there are no frames.
    StageTimes medians(std::size_t count) const;

private:
    std::size_t capacity_;
    std::vector<StageTimes> frames_;
};

} // namespace gnomon::viewer
