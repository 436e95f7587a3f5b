// The last frames' times by stage, for the graph and for medians that a person can read.
#pragma once

#include "telemetry/frame_row.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::viewer {

/// The stages of a frame in the order of the graph; the last is the window's own: overlay and presenting.
inline constexpr std::array kStageNames = {"plan", "select", "cull", "stream", "shadow", "image", "window"};
constexpr std::size_t kStages = kStageNames.size();

/// Milliseconds by stage.
using StageTimes = std::array<double, kStages>;

/// The stages of a row of the log, with what the window took.
StageTimes stageTimes(const telemetry::FrameRow& row, double windowMs);

/// The sum over the stages.
double total(const StageTimes& times);

/// Keeps the last `capacity` frames.
class FrameHistory {
public:
    explicit FrameHistory(std::size_t capacity) : capacity_(capacity) {}

    void add(const StageTimes& times);

    /// Oldest first.
    std::span<const StageTimes> frames() const { return frames_; }

    /// The median of each stage over the last `count` frames; zero before the first.
    StageTimes medians(std::size_t count) const;

private:
    std::size_t capacity_;
    std::vector<StageTimes> frames_;
};

} // namespace gnomon::viewer
