// The hysteresis values that a plan passes to the plan of the next frame. Plans share no other state.
#pragma once

#include "core/depth_span.h"
#include "shadow/quantized_near.h"
#include "shadow/warp/orientation.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::plan {

/// The hysteresis state of the ends of a frame's depth range. It exists only for frames with visible surfaces.
struct DepthMemory {
    shadow::NearState near;
    // Inverse of the far depth for stabilised slices. The inverse has the same hysteresis as the near depth.
    std::optional<shadow::NearState> inverseFar;
    std::optional<shadow::NearState> shownNear; // near end of DepthRange::shown; empty unless it is below near
    std::optional<shadow::NearState> inverseShownFar;
};

/// The recent view depths of visible surfaces that face the light. With these depths, a slice keeps its shadow map
/// while receivers appear and disappear for a few frames.
struct LitMemory {
    // depths during the last complete period of kFramesBeforeMapsGo frames; nullopt before the end of the first period
    std::optional<std::vector<DepthSpan>> before;
    std::vector<DepthSpan> since; // depths during the current period; both lists are disjoint and sorted
    int frames = 0;               // number of frames of the current period so far
};

/// The choices that define a shadow scheme: the number of slices, the face partitions, and the rotation and row spacing
/// of the maps.
struct SchemeChoice {
    int slices = 1;
    bool faces = false;
    bool lightRoll = true; // true: the maps are rotated about the light to minimise the storage factor
    bool logRows = false;  // true: `auto` chose logarithmic maps
    bool operator==(const SchemeChoice&) const = default;
};

/// The shadow scheme of a frame and its hysteresis state. A frame in which all slices are empty also has a scheme.
struct SchemeMemory {
    SchemeChoice choice;
    shadow::OrientationState orientation;
    std::uint64_t emptySlices = 0; // bit i: slice i has no map
    std::size_t maps = 0;
    LitMemory lit;
    int framesDominated = 0; // number of consecutive frames up to this frame in which another scheme was clearly better
};

/// All hysteresis values that one plan passes to the next plan. They are empty for the first frame.
struct PlanMemory {
    std::optional<DepthMemory> depth;
    std::optional<SchemeMemory> scheme;
};

} // namespace gnomon::plan
