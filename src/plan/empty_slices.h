// Which slices go without a map because nothing that is seen in them faces the light, and for how long that must have
// been so: a map that a receiver needs is there at once, and one that none needs stays while receivers come and go.
#pragma once

#include "plan/plan_memory.h"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::plan {

/// What is known of receivers when the slices of a frame after another are judged.
struct Receivers {
    LitMemory memory;            // with those of this frame
    std::vector<DepthSpan> over; // of the stretch that ends with this frame, if one does
    bool isStretchOver = false;
    bool haveArrived = false; // in a slice that went without a map in the frame before
};

/// The receivers of a frame in which `lit` faces the light and the slices of the frame before, if it had a scheme, lie
/// at `splits`.
Receivers receiversNow(
    std::span<const DepthSpan> lit, const std::optional<SchemeMemory>& before, std::span<const double> splits);

/// Bit i: nothing of `lit` lies in slice i of `splits`, whose end slices own what lies beyond them.
std::uint64_t slicesWithout(std::span<const DepthSpan> lit, std::span<const double> splits);

/// The slices that go without a map, as bits, in a frame after `before`. Where `isSameScheme` those of `before`
/// stay without, and what no receiver has needed over a whole stretch of frames goes; of another scheme, all that have
/// been empty for as long as is remembered. One arrival says that the view moves on to what it has not seen: all slices
/// have maps then, since the others would come to be needed one by one.
std::uint64_t slicesWithoutMap(
    const Receivers& receivers, std::span<const double> splits, const SchemeMemory& before, bool isSameScheme);

} // namespace gnomon::plan
