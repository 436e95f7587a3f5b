// The choice of slices that have no map, because no visible surface in them faces the light. A slice receives a map in
// the same frame as its first receiver. A slice loses its map only after a whole period of frames without receivers, so
// that maps do not appear and disappear.
#pragma once

#include "plan/plan_memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::plan {

/// The receivers of a frame and of the frames before it.
struct Receivers {
    LitMemory memory; // includes the receivers of this frame
    // depths of the receivers in the period that ends with this frame; empty if no period ends
    std::vector<DepthSpan> over;
    bool isStretchOver = false;
    bool haveArrived = false; // true: a slice that had no map in the previous frame has a receiver
};

/// Returns the receivers of a frame. `lit` contains the depths of the surfaces that face the light. `splits` are the
/// slices of the previous frame, if it had a scheme.
Receivers receiversNow(
    std::span<const DepthSpan> lit, const std::optional<SchemeMemory>& before, std::span<const double> splits);

/// Returns the slices without an element of `lit`, as bits: bit i is set for slice i of `splits`. The first slice
/// extends to depth 0 and the last slice to infinity.
std::uint64_t slicesWithout(std::span<const DepthSpan> lit, std::span<const double> splits);

/// Returns the slices that have no map in the frame after `before`, as bits. With `isSameScheme`, the empty slices of
/// `before` stay empty, and slices without receivers over a whole period become empty too. With another scheme, the
/// result contains the slices without receivers in both the last and the current period. If `receivers.haveArrived`,
/// the result is 0: the view moves to new regions, and the empty slices would otherwise need maps one by one.
std::uint64_t slicesWithoutMap(
    const Receivers& receivers, std::span<const double> splits, const SchemeMemory& before, bool isSameScheme);

} // namespace gnomon::plan
