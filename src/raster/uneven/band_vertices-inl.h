// The vertices of a cluster in a logarithmic shadow map, snapped for one band of rows. The header is compiled once per
// SIMD instruction set.
#if defined(GNOMON_RASTER_BAND_VERTICES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_RASTER_BAND_VERTICES_INL_H
#undef GNOMON_RASTER_BAND_VERTICES_INL_H
#else
#define GNOMON_RASTER_BAND_VERTICES_INL_H
#endif

#include "raster/triangle_lanes-inl.h"
#include "raster/uneven/row_bands.h"

#include <array>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::raster::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Max distance of a vertex from a band of rows, in units of the band. Larger distances are clamped to this value. Only
/// triangles whose edge functions need more than 32 bits extend so far, and for these the kernel needs only the
/// bounding box.
constexpr float kFarUnits = 0x1p29F; // differences of clamped values fit an int32

HWY_INLINE IntMask isLessOrEqual(Ints a, Ints b) {
    return hn::Lt(a, hn::Add(b, hn::Set(kInts, 1)));
}

/// A band of rows in a logarithmic shadow map, and the tile to draw.
struct BandLanes {
    const RowBand* band;
    const PixelBox* tile; // inside the band

    HWY_INLINE Ints row(Ints index) const { return hn::GatherIndex(kInts, band->rows.data(), index); }

    /// Returns the first row of the band at or above the height `units`, one height per SIMD lane. Heights are in units
    /// from the first row of the band.
    HWY_INLINE Ints firstRow(Ints units) const {
        const auto last = hn::Set(kInts, static_cast<std::int32_t>(band->rowsFromBucket.size()) - 1);
        const auto bucket = hn::Min(hn::ShiftRightSame(hn::Max(units, hn::Zero(kInts)), band->bucketBits), last);
        const auto found = hn::GatherIndex(kInts, band->rowsFromBucket.data(), bucket);
        return hn::Sub(found, hn::VecFromMask(kInts, hn::Lt(row(found), units)));
    }
};

/// The position of a vertex relative to the pixels of a tile, packed into one word:
/// - x, clamped to one tile width beside the tile,
/// - the first row at or above the vertex,
/// - a bit that is set if a row has exactly the height of the vertex.
struct VertexPlace {
    static constexpr int kColumnBits = 18;
    static constexpr int kRowBits = 9;
    static constexpr std::int32_t kBeside = kTileSide * kSubpixels;
    static_assert(3 * kBeside <= 1 << kColumnBits);
    static_assert(kMaxBandRows < 1 << kRowBits);

    static HWY_INLINE Ints packed(Ints x, Ints row, IntMask isAtRow) {
        const auto beside = hn::Set(kInts, kBeside);
        const auto held = hn::Min(hn::Max(hn::Add(x, beside), hn::Zero(kInts)), hn::Set(kInts, 3 * kBeside - 1));
        const auto rows = hn::Or(row, hn::And(hn::VecFromMask(kInts, isAtRow), hn::Set(kInts, 1 << kRowBits)));
        return hn::Or(held, hn::ShiftLeft<kColumnBits>(rows));
    }

    static HWY_INLINE Ints x(Ints place) {
        return hn::Sub(hn::And(place, hn::Set(kInts, (1 << kColumnBits) - 1)), hn::Set(kInts, kBeside));
    }

    /// Returns the first row at or above the vertex `place`.
    static HWY_INLINE Ints row(Ints place) {
        return hn::And(hn::ShiftRight<kColumnBits>(place), hn::Set(kInts, (1 << kRowBits) - 1));
    }

    static HWY_INLINE Ints rowAbove(Ints place) {
        return hn::Add(row(place), hn::ShiftRight<kColumnBits + kRowBits>(place));
    }
};

/// The vertices of a cluster, snapped for one band of rows: y in units of the band, packed snapping remainders, and
/// positions relative to the tile (VertexPlace). About six triangle corners share a vertex and each corner reads it
/// twice, so the values are computed once per vertex.
struct BandVertices { // NOLINT(cppcoreguidelines-pro-type-member-init): filled for the vertices of the cluster
    alignas(64) std::array<std::int32_t, kMaxClusterVertices> y;
    alignas(64) std::array<std::uint32_t, kMaxClusterVertices> rests;
    alignas(64) std::array<std::int32_t, kMaxClusterVertices> places;
    const std::int32_t* x; // x of the cluster's vertices, in the target
    bool isNarrow;         // true: each triangle of the cluster is narrow

    HWY_INLINE void take(const SnappedCluster& cluster, const BandLanes& rows) {
        const RowBand& band = *rows.band;
        x = cluster.vertices.x;
        const auto base = hn::Set(kFloats, band.base);
        const auto scale = hn::Set(kFloats, band.scale);
        const auto far = hn::Set(kFloats, kFarUnits);
        const auto originX = hn::Set(kInts, -rows.tile->x0 * kSubpixels);
        auto minX = hn::Set(kInts, hwy::HighestValue<std::int32_t>());
        auto minY = minX;
        auto maxX = hn::Set(kInts, hwy::LowestValue<std::int32_t>());
        auto maxY = maxX;
        const auto lanes = static_cast<std::uint32_t>(hn::Lanes(kInts));
        for (std::uint32_t i = 0; i < cluster.vertexCount; i += lanes) {
            const auto position = hn::BitCast(kFloats, hn::LoadU(kInts, cluster.vertices.y + i));
            const auto units = hn::Min(hn::Max(hn::Mul(hn::Sub(position, base), scale), hn::Neg(far)), far);
            const auto snapped = hn::NearestInt(units);
            const auto rest = hn::Mul(
                hn::Sub(units, hn::ConvertTo(kFloats, snapped)), hn::Set(kFloats, static_cast<float>(1 << kRestBits)));
            const auto restY = hn::NearestInt(hn::Min(rest, hn::Set(kFloats, 32767.0F)));
            const auto column = hn::LoadU(kInts, cluster.vertices.x + i);
            const auto restX = hn::BitCast(kInts, hn::LoadU(kUints, cluster.vertices.rests + i));
            hn::StoreU(snapped, kInts, y.data() + i);
            const auto low = hn::And(restX, hn::Set(kInts, 0xFFFF));
            hn::StoreU(hn::BitCast(kUints, hn::Or(low, hn::ShiftLeft<16>(restY))), kUints, rests.data() + i);
            const auto row = rows.firstRow(snapped);
            const auto place = VertexPlace::packed(hn::Add(column, originX), row, hn::Eq(rows.row(row), snapped));
            hn::StoreU(place, kInts, places.data() + i);
            minX = hn::Min(minX, column);
            maxX = hn::Max(maxX, column);
            minY = hn::Min(minY, snapped);
            maxY = hn::Max(maxY, snapped);
        }
        isNarrow = extent(minX, maxX) < kNarrowExtent && extent(minY, maxY) < kNarrowExtent;
    }

private:
    static HWY_INLINE std::int64_t extent(Ints low, Ints high) {
        return std::int64_t{hn::GetLane(hn::MaxOfLanes(kInts, high))} - hn::GetLane(hn::MinOfLanes(kInts, low));
    }
};

/// Loads the corners of a cluster's triangles from `vertices`, with one triangle per SIMD lane. x is relative to the
/// tile's first column, and y is in units of the band.
class UnevenSource {
public:
    HWY_INLINE UnevenSource(const BandVertices& vertices, const BandLanes& rows)
        : x_(vertices.x),
          y_(vertices.y.data()),
          rests_(reinterpret_cast<const std::int32_t*>(vertices.rests.data())),
          originX_(hn::Set(kInts, -rows.tile->x0 * kSubpixels)) {}

    HWY_INLINE PointLanes pointAt(Ints index) const {
        return {hn::Add(hn::GatherIndex(kInts, x_, index), originX_), hn::GatherIndex(kInts, y_, index)};
    }

    HWY_INLINE RestLanes restAt(Ints index) const { return unpackedRests(hn::GatherIndex(kInts, rests_, index)); }

private:
    const std::int32_t* x_;
    const std::int32_t* y_;
    const std::int32_t* rests_;
    Ints originX_;
};

} // namespace gnomon::raster::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
