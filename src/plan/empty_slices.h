// The choice of slices that need no shadow map, because no visible surface in them faces the light. A slice receives a
// map in the same frame as its first receiver. A slice loses its map only after kFramesBeforeMapsGo frames without
// receivers, so that maps do not appear and disappear repeatedly.
#pragma once

#include "plan/plan_memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::plan {

/// The depths of the receivers in a frame and in the frames before it.
struct Receivers {
    LitMemory memory; // includes the receivers of this frame
    // if a period of kFramesBeforeMapsGo frames ends with this frame: depths of all receivers during the period
    std::vector<DepthSpan> over;
    bool isStretchOver = false;
    bool haveArrived = false; // true: a slice that had no map in the previous frame has a receiver
};

/// Returns the receivers of a frame. `lit` contains the depths of the visible surfaces that face the light. `before` is
/// the memory of the previous frame, if it had a scheme, and `splits` are the ends of its slices.
Receivers receiversNow(
    std::span<const DepthSpan> lit, const std::optional<SchemeMemory>& before, std::span<const double> splits);

/// Returns the slices without a depth span of `lit`, as bits: bit i is set for slice i of `splits`. The first slice
/// extends to depth 0 and the last slice to infinity.
std::uint64_t slicesWithout(std::span<const DepthSpan> lit, std::span<const double> splits);

/// Returns the slices that have no map in the frame after `before`, as bits. If `isSameScheme`, the empty slices of
/// `before` stay empty. At the end of a period, the slices without receivers during the whole period also become empty.
/// With another scheme, slices are empty if they had no receivers in the last and in the current period. If
/// `receivers.haveArrived`, the result is 0: the view moves to new regions, and the empty slices would otherwise need
/// maps one after another.
std::uint64_t slicesWithoutMap(
    const Receivers& receivers, std::span<const double> splits, const SchemeMemory& before, bool isSameScheme);

} // namespace gnomon::plan
