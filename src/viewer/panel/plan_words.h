// Describes the plan of a frame in words for the window: its shadow maps, light and cost.
#pragma once

#include "plan/frame_plan.h"
#include "telemetry/frame_row.h"

#include <string>
#include <vector>

namespace gnomon::viewer {

/// Returns a few short lines about the plan of a frame: the shadow scheme and its maps, the light, the depth range, the
/// max perspective aliasing with its measured value, and the reasons for skipped passes.
std::vector<std::string> planInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row);

/// Properties of the shown image that the log row of its last frame does not contain.
struct PictureState {
    double frameMs = 0;     // typical time of the last frames
    int samples = 0;        // frames in the mean; 0: the image is not a mean
    int maxSamples = 1;     // number of frames in the finished mean
    std::string reductions; // reductions of the quality governor; empty: none
};

/// Returns one status line about the image: frame time, triangles, max perspective aliasing, quality reductions and
/// pending work.
std::string statusInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row, const PictureState& state);

/// The limits of the load: the number of pages of the model, and the max memory of the CPU and the GPU.
struct Caps {
    std::uint64_t pages = 0; // pages of the model
    std::uint64_t memoryBytes = 0;
    std::uint64_t gpuMemoryBytes = 0;
};

/// Returns lines about the drawn triangles, pages and memory, compared with their limits in `caps`.
std::vector<std::string> loadInWords(
    const telemetry::FrameRow& row, const plan::Quality& quality, const Caps& caps, std::uint64_t pagesInCut);

} // namespace gnomon::viewer
