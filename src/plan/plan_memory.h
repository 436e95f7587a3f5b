// The state that a plan passes to the plan of the next frame. No other state is passed from frame to frame.
#pragma once

#include "core/depth_span.h"
#include "shadow/quantized_near.h"
#include "shadow/warp/orientation.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::plan {

/// The ends of the depth range of a frame with visible surfaces.
struct DepthMemory {
    shadow::NearState near;
    // 1 / far of stabilised slices, which has the same hysteresis as near
    std::optional<shadow::NearState> inverseFar;
    std::optional<shadow::NearState> shownNear; // near end of the shown range; empty unless it is below near
    std::optional<shadow::NearState> inverseShownFar;
};

/// The recent depths of the visible surfaces that face the light. With them, a slice keeps its map while receivers
/// appear and disappear.
struct LitMemory {
    // depths during the last complete period; nullopt before the end of the first period
    std::optional<std::vector<DepthSpan>> before;
    std::vector<DepthSpan> since; // depths during the current period; both lists are disjoint and sorted
    int frames = 0;               // length of the current period
};

/// The scheme of a plan.
struct SchemeChoice {
    int slices = 1;
    bool faces = false;
    bool lightRoll = true; // true: the maps are rotated about the light to minimise the storage factor
    bool logRows = false;  // true: `auto` chose logarithmic maps
    bool operator==(const SchemeChoice&) const = default;
};

/// The scheme of a frame with maps, or of a frame in which all slices are empty.
struct SchemeMemory {
    SchemeChoice choice;
    shadow::OrientationState orientation;
    std::uint64_t emptySlices = 0; // bit i: slice i has no map
    std::size_t maps = 0;
    LitMemory lit;
    int framesDominated = 0; // number of consecutive frames, including this frame, in which another scheme dominates
};

/// The complete memory between plans. It is empty before the first frame.
struct PlanMemory {
    std::optional<DepthMemory> depth;
    std::optional<SchemeMemory> scheme;
};

} // namespace gnomon::plan
