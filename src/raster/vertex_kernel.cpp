#include "raster/vertex_kernel.h"

#include "raster/uneven/row_bands.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/vertex_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using IntTag = hn::ScalableTag<std::int32_t>;
using FloatTag = hn::ScalableTag<float>;
using Ints = hn::Vec<IntTag>;
using Floats = hn::Vec<FloatTag>;

constexpr IntTag kInts;
constexpr FloatTag kFloats;
constexpr hn::RebindToUnsigned<IntTag> kUints;

struct Positions {
    Floats x, y, z, w;
};

struct Cells {
    Ints x, y, z;
};

/// Loads the positions of vertices from `first` on, with one vertex per SIMD lane. Lanes beyond the last vertex receive
/// the last vertex.
HWY_INLINE Cells gatheredCells(const Cluster& cluster, std::uint32_t first) {
    const auto last = hn::Set(kInts, static_cast<std::int32_t>(cluster.vertexCount) - 1);
    const auto index = hn::Min(hn::Iota(kInts, static_cast<std::int32_t>(first)), last);
    const auto offset = hn::Mul(index, hn::Set(kInts, static_cast<std::int32_t>(cluster.positionStride)));
    const auto* base = reinterpret_cast<const std::int32_t*>(cluster.positions);
    return {
        hn::GatherOffset(kInts, base, offset),
        hn::GatherOffset(kInts, base + 1, offset),
        hn::GatherOffset(kInts, base + 2, offset)};
}

#if HWY_TARGET == HWY_SCALAR || HWY_HAVE_SCALABLE

HWY_INLINE Cells cellsOf(const Cluster& cluster, std::uint32_t first) {
    return gatheredCells(cluster, first);
}

#else

/// Loads four 32-bit words of each of the vertices first, first + 4, and so on. Each vertex fills one block of four
/// SIMD lanes.
template <class Tag>
HWY_INLINE hn::Vec<Tag> everyFourth(Tag tag, const Cluster& cluster, std::uint32_t first) {
    if constexpr (hn::MaxLanes(tag) == 4) {
        const std::size_t vertex = std::min(first, cluster.vertexCount - 1);
        const std::uint32_t* words = cluster.positions + vertex * (cluster.positionStride / sizeof(std::uint32_t));
        return hn::LoadU(tag, reinterpret_cast<const std::int32_t*>(words));
    } else {
        constexpr hn::Half<Tag> kHalf;
        const auto upper = everyFourth(kHalf, cluster, first + static_cast<std::uint32_t>(hn::MaxLanes(kHalf)));
        return hn::Combine(tag, upper, everyFourth(kHalf, cluster, first));
    }
}

/// Loads the positions of vertices from `first` on, with one vertex per SIMD lane. The function loads whole vertices
/// and transposes them in blocks of four, because gathers take several times as long. Vertices of twelve bytes need
/// gathers, because a load of four words could read beyond the end of the array.
HWY_INLINE Cells cellsOf(const Cluster& cluster, std::uint32_t first) {
    if (cluster.positionStride < 4 * sizeof(std::uint32_t)) return gatheredCells(cluster, first);
    constexpr hn::Repartition<std::int64_t, IntTag> kPairs;
    const auto a = everyFourth(kInts, cluster, first);
    const auto b = everyFourth(kInts, cluster, first + 1);
    const auto c = everyFourth(kInts, cluster, first + 2);
    const auto d = everyFourth(kInts, cluster, first + 3);
    const auto xyOfAb = hn::BitCast(kPairs, hn::InterleaveLower(kInts, a, b));
    const auto xyOfCd = hn::BitCast(kPairs, hn::InterleaveLower(kInts, c, d));
    const auto zOfAb = hn::BitCast(kPairs, hn::InterleaveUpper(kInts, a, b));
    const auto zOfCd = hn::BitCast(kPairs, hn::InterleaveUpper(kInts, c, d));
    return {
        hn::BitCast(kInts, hn::InterleaveLower(kPairs, xyOfAb, xyOfCd)),
        hn::BitCast(kInts, hn::InterleaveUpper(kPairs, xyOfAb, xyOfCd)),
        hn::BitCast(kInts, hn::InterleaveLower(kPairs, zOfAb, zOfCd))};
}

#endif

HWY_INLINE Floats difference(Ints cell, std::int32_t eyeCell) {
    return hn::ConvertTo(kFloats, hn::Sub(cell, hn::Set(kInts, eyeCell)));
}

HWY_INLINE Floats row(const Projection& projection, std::size_t i, Floats x, Floats y, Floats z) {
    const auto& m = projection.clipFromCell;
    const auto xy = hn::Add(hn::Mul(hn::Set(kFloats, m[i]), x), hn::Mul(hn::Set(kFloats, m[4 + i]), y));
    return hn::Add(hn::Add(xy, hn::Mul(hn::Set(kFloats, m[8 + i]), z)), hn::Set(kFloats, m[12 + i]));
}

HWY_INLINE Positions clipPositions(const Projection& projection, const Cells& cells) {
    const auto x = difference(cells.x, static_cast<std::int32_t>(projection.eyeCell[0]));
    const auto y = difference(cells.y, static_cast<std::int32_t>(projection.eyeCell[1]));
    const auto z = difference(cells.z, static_cast<std::int32_t>(projection.eyeCell[2]));
    return {
        row(projection, 0, x, y, z),
        row(projection, 1, x, y, z),
        row(projection, 2, x, y, z),
        row(projection, 3, x, y, z)};
}

HWY_INLINE Ints insideGuard(const Projection& projection, const Positions& p) {
    auto inside = hn::Ge(p.w, hn::Set(kFloats, kMinW));
    inside = hn::And(inside, hn::Le(hn::Abs(p.x), hn::Mul(hn::Set(kFloats, projection.guardX), p.w)));
    inside = hn::And(inside, hn::Le(hn::Abs(p.y), hn::Mul(hn::Set(kFloats, projection.guardY), p.w)));
    if (projection.cutsDepth) inside = hn::And(inside, hn::And(hn::Ge(p.z, hn::Zero(kFloats)), hn::Le(p.z, p.w)));
    return hn::VecFromMask(kInts, hn::RebindMask(kInts, inside));
}

HWY_INLINE Ints bitWhere(hn::Mask<FloatTag> mask, std::int32_t bit) {
    return hn::And(hn::VecFromMask(kInts, hn::RebindMask(kInts, mask)), hn::Set(kInts, bit));
}

HWY_INLINE Ints outside(const Projection& projection, const Positions& p) {
    const auto left = hn::Mul(hn::Set(kFloats, projection.lowX), p.w);
    const auto right = hn::Mul(hn::Set(kFloats, projection.highX), p.w);
    auto bits = hn::Or(bitWhere(hn::Lt(p.x, left), 1), bitWhere(hn::Gt(p.x, right), 2));
    const auto low = hn::Mul(hn::Set(kFloats, projection.lowY), p.w);
    const auto high = hn::Mul(hn::Set(kFloats, projection.highY), p.w);
    bits = hn::Or(bits, hn::Or(bitWhere(hn::Lt(p.y, low), 4), bitWhere(hn::Gt(p.y, high), 8)));
    if (projection.cutsDepth)
        bits = hn::Or(bits, hn::Or(bitWhere(hn::Gt(p.z, p.w), 16), bitWhere(hn::Lt(p.z, hn::Zero(kFloats)), 32)));
    return bits;
}

struct SnappedAxis {
    Ints snapped;
    Ints rest;
};

HWY_INLINE SnappedAxis snappedAxis(Floats coordinate, Floats inverseW, float scale, float translate) {
    const auto pixels =
        hn::Add(hn::Mul(hn::Mul(coordinate, inverseW), hn::Set(kFloats, scale)), hn::Set(kFloats, translate));
    const auto whole =
        hn::Mul(hn::Sub(pixels, hn::Set(kFloats, 0.5F)), hn::Set(kFloats, static_cast<float>(kSubpixels)));
    const auto snapped = hn::NearestInt(whole);
    const auto rest =
        hn::Mul(hn::Sub(whole, hn::ConvertTo(kFloats, snapped)), hn::Set(kFloats, static_cast<float>(1 << kRestBits)));
    return {snapped, hn::NearestInt(hn::Min(rest, hn::Set(kFloats, 32767.0F)))};
}

HWY_INLINE Floats snappedDepth(Floats z, Floats inverseW) {
    const auto limit = hn::Set(kFloats, kDepthLimit);
    return hn::Add(hn::Min(hn::Max(hn::Mul(z, inverseW), hn::Neg(limit)), limit), hn::Zero(kFloats));
}

/// The y of the vertices of a logarithmic map, and the min and max over all vertices so far.
struct UnevenAxis {
    Floats lowest, highest;

    HWY_INLINE UnevenAxis()
        : lowest(hn::Set(kFloats, hwy::HighestValue<float>())), highest(hn::Set(kFloats, hwy::LowestValue<float>())) {}

    HWY_INLINE SnappedAxis take(Floats coordinate, Floats inverseW) {
        const auto position = hn::Mul(coordinate, inverseW);
        lowest = hn::Min(lowest, position);
        highest = hn::Max(highest, position);
        return {hn::BitCast(kInts, position), hn::Zero(kInts)};
    }

    HWY_INLINE float min() const { return hn::GetLane(hn::MinOfLanes(kFloats, lowest)); }

    HWY_INLINE float max() const { return hn::GetLane(hn::MaxOfLanes(kFloats, highest)); }
};

/// Stores a compact cluster if `box` is small enough: packs x and y of each vertex into the words of snapped.x, and
/// returns true. Otherwise stores y separately, and returns false.
HWY_INLINE bool join(const SnappedArrays& snapped, const std::int32_t* y, std::uint32_t count, const PixelBox& box) {
    const bool isCompact = std::max(box.width(), box.height()) <= kMaxCompactPixels;
    const auto originX = hn::Set(kInts, (box.x0 - 1) * kSubpixels);
    const auto originY = hn::Set(kInts, (box.y0 - 1) * kSubpixels);
    for (std::uint32_t i = 0; i < count; i += static_cast<std::uint32_t>(hn::Lanes(kInts))) {
        const auto high = hn::LoadU(kInts, y + i);
        if (isCompact) {
            const auto low = hn::Sub(hn::LoadU(kInts, snapped.x + i), originX);
            hn::StoreU(hn::Or(low, hn::ShiftLeft<16>(hn::Sub(high, originY))), kInts, snapped.x + i);
        } else {
            hn::StoreU(high, kInts, snapped.y + i);
        }
    }
    return isCompact;
}

VertexStage snapVerticesInLanes(const Projection& projection, const Cluster& cluster, const SnappedArrays& snapped) {
    const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
    std::array<std::int32_t, kMaxClusterVertices> allY; // NOLINT(cppcoreguidelines-pro-type-member-init): filled below
    auto allInside = hn::Set(kInts, -1);
    auto allOutside = hn::Set(kInts, -1);
    auto minX = hn::Set(kInts, hwy::HighestValue<std::int32_t>());
    auto minY = minX;
    auto maxX = hn::Set(kInts, hwy::LowestValue<std::int32_t>());
    auto maxY = maxX;
    auto maxZ = hn::Set(kFloats, -kDepthLimit);
    const bool isUneven = projection.rows != nullptr;
    UnevenAxis alongY;
    for (std::uint32_t first = 0; first < cluster.vertexCount; first += lanes) {
        const Positions p = clipPositions(projection, cellsOf(cluster, first));
        allInside = hn::And(allInside, insideGuard(projection, p));
        allOutside = hn::And(allOutside, outside(projection, p));
        const auto inverseW = hn::Div(hn::Set(kFloats, 1.0F), p.w);
        const auto [x, restX] = snappedAxis(p.x, inverseW, projection.scaleX, projection.translateX);
        const auto [y, restY] = isUneven ? alongY.take(p.y, inverseW)
                                         : snappedAxis(p.y, inverseW, projection.scaleY, projection.translateY);
        const auto rests = hn::Or(hn::And(restX, hn::Set(kInts, 0xFFFF)), hn::ShiftLeft<16>(restY));
        hn::StoreU(hn::BitCast(kUints, rests), kUints, snapped.rests + first);
        hn::StoreU(x, kInts, snapped.x + first);
        hn::StoreU(y, kInts, allY.data() + first);
        const auto z = snappedDepth(p.z, inverseW);
        hn::StoreU(z, kFloats, snapped.z + first);
        maxZ = hn::Max(maxZ, z);
        minX = hn::Min(minX, x);
        minY = hn::Min(minY, y);
        maxX = hn::Max(maxX, x);
        maxY = hn::Max(maxY, y);
    }
    VertexStage stage;
    std::int32_t outsideAny = 0; // bits of all planes that some vertex is outside of
    for (const std::int32_t bit : {1, 2, 4, 8, 16, 32})
        if (hn::AllTrue(kInts, hn::TestBit(allOutside, hn::Set(kInts, bit)))) outsideAny |= bit;
    if (outsideAny != 0) return stage;
    if (!hn::AllTrue(kInts, hn::Lt(allInside, hn::Zero(kInts)))) {
        stage.place = ClusterPlace::Cut;
        return stage;
    }
    stage.place = ClusterPlace::Inside;
    stage.box = {
        (hn::GetLane(hn::MinOfLanes(kInts, minX)) + kSubpixels - 1) >> kSubpixelBits,
        (hn::GetLane(hn::MinOfLanes(kInts, minY)) + kSubpixels - 1) >> kSubpixelBits,
        (hn::GetLane(hn::MaxOfLanes(kInts, maxX)) >> kSubpixelBits) + 1,
        (hn::GetLane(hn::MaxOfLanes(kInts, maxY)) >> kSubpixelBits) + 1};
    stage.maxZ = hn::GetLane(hn::MaxOfLanes(kFloats, maxZ));
    if (isUneven) {
        const auto [firstRow, endRow] = projection.rows->rowsBetween(alongY.min(), alongY.max());
        stage.box.y0 = firstRow;
        stage.box.y1 = endRow;
        std::copy_n(allY.data(), paddedVertexCount(cluster.vertexCount), snapped.y);
        return stage;
    }
    stage.isCompact = join(snapped, allY.data(), cluster.vertexCount, stage.box);
    return stage;
}

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::raster {

HWY_EXPORT(snapVerticesInLanes);

VertexStage snapVertices(const Projection& projection, const Cluster& cluster, const SnappedArrays& snapped) {
    return HWY_DYNAMIC_DISPATCH(snapVerticesInLanes)(projection, cluster, snapped);
}

} // namespace gnomon::raster
#endif
