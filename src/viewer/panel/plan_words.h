// A frame's plan in the words of a person.
#pragma once

#include "plan/frame_plan.h"
#include "telemetry/frame_row.h"

#include <string>
#include <vector>

namespace gnomon::viewer {

/// A few short lines: the scheme and its maps, the light, the depth range, the promise and what was measured of it,
/// and why effects are left out.
std::vector<std::string> planInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row);

/// What a window knows of its picture besides the last frame's row.
struct PictureState {
    double frameMs = 0;  // the usual of the last frames
    int samples = 0;     // frames that the picture is the mean of; 0: it is not to become one
    int mostSamples = 1; // when it is done
    std::string givenUp; // for the time target; empty: nothing
};

/// All of it in a line: time, triangles, what shadows promise, what is given up, and what is still to come.
std::string statusInWords(const plan::FramePlan& plan, const telemetry::FrameRow& row, const PictureState& state);

/// Lines for what was drawn: triangles, pages and memory against their caps.
struct Caps {
    std::uint64_t pages = 0; // of the model
    std::uint64_t memoryBytes = 0;
    std::uint64_t gpuMemoryBytes = 0;
};

std::vector<std::string> loadInWords(
    const telemetry::FrameRow& row, const plan::Quality& quality, const Caps& caps, std::uint64_t pagesInCut);

} // namespace gnomon::viewer
