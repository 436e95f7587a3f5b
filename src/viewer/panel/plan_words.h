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

/// Lines for what was drawn: triangles, pages and memory against their caps.
struct Caps {
    std::uint64_t pages = 0; // of the model
    std::uint64_t memoryBytes = 0;
    std::uint64_t gpuMemoryBytes = 0;
};

std::vector<std::string> loadInWords(
    const telemetry::FrameRow& row, const plan::Quality& quality, const Caps& caps, std::uint64_t pagesInCut);

} // namespace gnomon::viewer
