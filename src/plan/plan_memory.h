// What the plan of the next frame has to know of this one: nothing else carries over from frame to frame.
#pragma once

#include "core/depth_span.h"
#include "shadow/quantized_near.h"
#include "shadow/warp/orientation.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::plan {

/// The ends of the depth range, of a frame in which anything was in view.
struct DepthMemory {
    shadow::NearState near;
    std::optional<shadow::NearState> inverseFar; // 1 / far, which moves as near does; of stabilised slices
    std::optional<shadow::NearState> shownNear;  // where shadows are shown from, while that is before near
    std::optional<shadow::NearState> inverseShownFar;
};

/// At which depths visible surfaces have faced the light of late: maps do not go while receivers come and go.
struct LitMemory {
    std::optional<std::vector<DepthSpan>> before; // over the last whole stretch of frames; nothing: it is not over yet
    std::vector<DepthSpan> since;                 // over the stretch that goes on; apart and in order, both
    int frames = 0;                               // that it has gone on for
};

/// Which scheme a plan came to.
struct SchemeChoice {
    int slices = 1;
    bool faces = false;
    bool lightRoll = true; // the maps are rolled about the light for the least storage
    bool logRows = false;  // where `auto` chose the warp
    bool operator==(const SchemeChoice&) const = default;
};

/// The scheme of a frame with maps, or whose every slice went without one.
struct SchemeMemory {
    SchemeChoice choice;
    shadow::OrientationState orientation;
    std::uint64_t emptySlices = 0; // bit i: slice i went without a map
    std::size_t maps = 0;
    LitMemory lit;
    int framesDominated = 0; // for how many frames, that one included, another scheme has dominated it
};

/// All of it; empty before the first frame.
struct PlanMemory {
    std::optional<DepthMemory> depth;
    std::optional<SchemeMemory> scheme;
};

} // namespace gnomon::plan
