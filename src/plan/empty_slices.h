// Finds the depth slices that need no shadow map, because no visible surface in them faces the light. A slice receives
// a map in the same frame as its first receiver. A slice loses its map only after kFramesBeforeMapsGo frames without
// receivers, so that maps do not appear and disappear repeatedly.
#pragma once

#include "plan/plan_memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::plan {

/// The view depths at which receivers are visible, in this frame and in recent frames.
struct Receivers {
    LitMemory memory; // includes the receivers of this frame
    // depths of all receivers in the last kFramesBeforeMapsGo frames; only if such a period ends with this frame
    std::vector<DepthSpan> over;
    bool isStretchOver = false;
    bool haveArrived = false; // true: a slice that had no map in the previous frame has a receiver
};

/// Combines the receivers of a frame with those of recent frames. `lit` contains the depths of the visible surfaces
/// that face the light. `before` is the state after the previous frame, if it had shadow maps. `splits` are the depths
/// that separate the slices.
Receivers receiversNow(
    std::span<const DepthSpan> lit, const std::optional<SchemeMemory>& before, std::span<const double> splits);

/// Returns a bit mask of the slices without receivers: bit i is set if no depth in `lit` lies in slice i of `splits`.
/// The first slice extends to depth 0 and the last slice to infinity.
std::uint64_t slicesWithout(std::span<const DepthSpan> lit, std::span<const double> splits);

/// Returns a bit mask of the slices that need no shadow map in the frame after `before`. If `isSameScheme`, the slices
/// without a map in `before` stay without a map. When a period of kFramesBeforeMapsGo frames ends, the slices without
/// receivers during the period also lose their maps. If the scheme changed, a slice has no map if it had no receivers
/// in the last and in the current period. If `receivers.haveArrived`, the result is 0, so all slices have maps: the
/// view moves to new regions, and the slices would otherwise need maps one after another.
std::uint64_t slicesWithoutMap(
    const Receivers& receivers, std::span<const double> splits, const SchemeMemory& before, bool isSameScheme);

} // namespace gnomon::plan
