// The triangles of a cluster, packed into 32-bit words and sorted by size class. The header is compiled once per SIMD
// instruction set.
#if defined(GNOMON_RASTER_SORTED_TRIANGLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_SORTED_TRIANGLES_INL_H
#undef GNOMON_RASTER_SORTED_TRIANGLES_INL_H
#else
#define GNOMON_RASTER_SORTED_TRIANGLES_INL_H
#endif

#include "raster/triangle_lanes-inl.h"

#include <algorithm>
#include <array>
#include <span>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The triangles of one size class, as one 32-bit word per triangle: three bytes for the corner indices, and the upper
/// byte for the index of the triangle.
struct Sorted { // NOLINT(cppcoreguidelines-pro-type-member-init): elements are set when `count` grows
    std::array<std::uint32_t, kMaxClusterTriangles + 3 * kMaxLanes> packed;
    std::uint32_t count = 0;

    HWY_INLINE void add(Ints lanes, hn::Mask<IntTag> mask) {
        hn::StoreU(hn::BitCast(kUints, hn::Compress(lanes, mask)), kUints, packed.data() + count);
        count += static_cast<std::uint32_t>(hn::CountTrue(kInts, mask));
    }

    HWY_INLINE Ints at(std::uint32_t i) const { return hn::BitCast(kInts, hn::LoadU(kUints, packed.data() + i)); }

    /// Fills up the last SIMD vector with triangles whose area is 0.
    HWY_INLINE void pad() { std::fill_n(packed.data() + count, kMaxLanes, 0U); }
};

struct SortedCluster {
    Sorted tiny;   // bounding box of at most 2 x 2 pixel centres
    Sorted small;  // bounding box of at most 4 x 4 pixel centres
    Sorted narrow; // bounding box smaller than kNarrowExtent
    Sorted wide;

    HWY_INLINE void clear() { tiny.count = small.count = narrow.count = wide.count = 0; }

    /// Fills up the last SIMD vector of each size class that uses SIMD triangle setup.
    HWY_INLINE void pad() {
        tiny.pad();
        small.pad();
        narrow.pad();
    }
};

/// The triangles of a cluster as one 32-bit word each, padded with triangles whose area is 0.
using PackedTriangles = std::array<std::uint32_t, kMaxClusterTriangles + kMaxLanes>;

HWY_INLINE void packTriangles(std::span<const Triangle> triangles, PackedTriangles& packed) {
    const std::size_t count = triangles.size();
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
    // Four triangles have twelve bytes, but the load reads sixteen bytes, all of which must be inside the array.
    constexpr hn::FixedTag<std::uint8_t, 16> kBytes;
    constexpr hn::FixedTag<std::uint32_t, 4> kFour;
    constexpr std::uint8_t kZero = 0x80;
    alignas(16) static constexpr std::array<std::uint8_t, 16> kSpread = {
        0, 1, 2, kZero, 3, 4, 5, kZero, 6, 7, 8, kZero, 9, 10, 11, kZero};
    const auto spread = hn::Load(kBytes, kSpread.data());
    const std::uint8_t* bytes = triangles.empty() ? nullptr : triangles.front().data();
    for (; 3 * i + 16 <= 3 * count; i += 4) {
        const auto corners = hn::TableLookupBytesOr0(hn::LoadU(kBytes, bytes + 3 * i), spread);
        const auto places = hn::ShiftLeft<24>(hn::Iota(kFour, static_cast<std::uint32_t>(i)));
        hn::StoreU(hn::Or(hn::BitCast(kFour, corners), places), kFour, packed.data() + i);
    }
#endif
    for (; i < count; ++i)
        packed[i] = triangles[i][0] | std::uint32_t{triangles[i][1]} << 8U | std::uint32_t{triangles[i][2]} << 16U |
                    static_cast<std::uint32_t>(i) << 24U;
    std::fill_n(packed.data() + count, kMaxLanes, 0U);
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
