#include "exact/caster_kernel.h"

#include "exact/float_rounding.h"
#include "exact/point_predicate.h"
#include "exact/pyramid_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

// The order matters: foreach_target.h includes this file again for each instruction set.
// clang-format off
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "exact/caster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include "exact/cluster_caster-inl.h"
// clang-format on

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {

void ClusterCaster::rasterizeInto(std::size_t map) {
    const GridMap& cells = context_.grid->maps()[map];
    const bool isPoint = context_.samples->space().pointLight.has_value();
    if (isPoint) findNearness(cells);
    const glm::dmat4x3& m = cells.cellsFromLight;
    double minW = std::numeric_limits<double>::infinity();
    double maxW = -minW;
    for (std::size_t i = 0; i < caster_.geometry.vertexCount; ++i) {
        const double u = sheared_[i][0];
        const double v = sheared_[i][1];
        const double h = sheared_[i][2];
        const double w = m[0][2] * u + m[1][2] * v + m[2][2] * h + m[3][2];
        w_[i] = w;
        minW = std::min(minW, w);
        maxW = std::max(maxW, w);
        x_[i] = (m[0][0] * u + m[1][0] * v + m[2][0] * h + m[3][0]) / w;
        y_[i] = (m[0][1] * u + m[1][1] * v + m[2][1] * h + m[3][1]) / w;
        floatX_[i] = static_cast<float>(x_[i]);
        floatY_[i] = static_cast<float>(y_[i]);
    }
    if (isPoint ? maxW <= 0 : maxW < cells.minW) return;
    if (minW >= cells.minW)
        rasterizeWhole(map);
    else if (isPoint)
        rasterizeNearLight(map);
    else
        rasterizeClipped(map);
}

/// Tests all triangles of the cluster, if the map's w is large enough at all corners. Each SIMD lane computes the box
/// of cells that one triangle covers, and tests the box against the receiver mask.
void ClusterCaster::rasterizeWhole(std::size_t map) {
    const SampleGrid& grid = *context_.grid;
    const std::size_t count = caster_.geometry.triangles.size();
    const auto side = hn::Set(kFloats, static_cast<float>(grid.side()));
    const auto last = hn::Set(kFloats, static_cast<float>(grid.side() - 1));
    const auto slack = hn::Set(kFloats, static_cast<float>(kCellSlack));
    const auto zero = hn::Zero(kFloats);
    alignas(64) std::int32_t boxes[4][16];
    alignas(64) float highest[16];
    for (std::size_t t = 0; t < count; t += hn::Lanes(kInts)) {
        const auto a = hn::Load(kInts, &corner_[0][t]);
        const auto b = hn::Load(kInts, &corner_[1][t]);
        const auto c = hn::Load(kInts, &corner_[2][t]);
        const auto min = [&](const std::array<float, kMaxVertices>& from) HWY_ATTR {
            const auto ab = hn::Min(hn::GatherIndex(kFloats, from.data(), a), hn::GatherIndex(kFloats, from.data(), b));
            return hn::Min(ab, hn::GatherIndex(kFloats, from.data(), c));
        };
        const auto max = [&](const std::array<float, kMaxVertices>& from) HWY_ATTR {
            const auto ab = hn::Max(hn::GatherIndex(kFloats, from.data(), a), hn::GatherIndex(kFloats, from.data(), b));
            return hn::Max(ab, hn::GatherIndex(kFloats, from.data(), c));
        };
        const auto x0 = hn::Sub(min(floatX_), slack);
        const auto x1 = hn::Add(max(floatX_), slack);
        const auto y0 = hn::Sub(min(floatY_), slack);
        const auto y1 = hn::Add(max(floatY_), slack);
        auto isIn = hn::And(hn::And(hn::Ge(x1, zero), hn::Ge(y1, zero)), hn::And(hn::Lt(x0, side), hn::Lt(y0, side)));
        isIn = hn::And(isIn, hn::FirstN(kFloats, count - t));
        if (hn::AllFalse(kFloats, isIn)) continue;
        const auto cell = [&](Floats x) HWY_ATTR {
            return hn::ConvertTo(kInts, hn::Min(hn::Max(x, zero), last)); // truncates
        };
        hn::Store(cell(x0), kInts, boxes[0]);
        hn::Store(cell(y0), kInts, boxes[1]);
        hn::Store(cell(x1), kInts, boxes[2]);
        hn::Store(cell(y1), kInts, boxes[3]);
        hn::Store(max(floatH_), kFloats, highest);
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(kFloats, isIn, bits);
        for (unsigned lanes = bits[0] | static_cast<unsigned>(bits[1]) << 8U; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::size_t>(__builtin_ctz(lanes));
            const CellBox box{boxes[0][lane], boxes[1][lane], boxes[2][lane], boxes[3][lane]};
            if (grid.mask(map).mayShadow(box, highest[lane])) rasterizeTriangle(map, t + lane, box, true);
        }
    }
}

/// Tests triangles that are partly behind the centre of the map's warp. Only the part of a triangle with w of at least
/// GridMap::minW can cover a sample.
void ClusterCaster::rasterizeClipped(std::size_t map) {
    const GridMap& cells = context_.grid->maps()[map];
    const int side = context_.grid->side();
    for (std::size_t t = 0; t < caster_.geometry.triangles.size(); ++t) {
        glm::dvec2 low(std::numeric_limits<double>::infinity());
        glm::dvec2 high(-std::numeric_limits<double>::infinity());
        const auto add = [&](const glm::dvec3& p) {
            low = glm::min(low, glm::dvec2(p) / p.z);
            high = glm::max(high, glm::dvec2(p) / p.z);
        };
        float highest = -std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 p = place(cells, static_cast<std::size_t>(corner_[k][t]));
            const glm::dvec3 q = place(cells, static_cast<std::size_t>(corner_[(k + 1) % 3][t]));
            highest = std::max(highest, floatH_[static_cast<std::size_t>(corner_[k][t])]);
            if (p.z >= cells.minW) add(p);
            if ((p.z >= cells.minW) == (q.z >= cells.minW)) continue;
            const double share = (cells.minW - p.z) / (q.z - p.z);
            add({glm::dvec2(p) + share * (glm::dvec2(q) - glm::dvec2(p)), cells.minW});
        }
        if (!(high.x >= -kCellSlack && high.y >= -kCellSlack && low.x <= side + kCellSlack &&
              low.y <= side + kCellSlack))
            continue;
        const CellBox box{
            cellAt(low.x - kCellSlack, side),
            cellAt(low.y - kCellSlack, side),
            cellAt(high.x + kCellSlack, side),
            cellAt(high.y + kCellSlack, side)};
        if (context_.grid->mask(map).mayShadow(box, highest)) rasterizeTriangle(map, t, box, false);
    }
}

/// Tests the triangles of a cluster that extends beside or behind the point light.
void ClusterCaster::rasterizeNearLight(std::size_t map) {
    const GridMap& cells = context_.grid->maps()[map];
    const int side = context_.grid->side();
    for (std::size_t t = 0; t < caster_.geometry.triangles.size(); ++t) {
        std::array<glm::dvec3, 3> places{};
        float highest = -std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(corner_[k][t]);
            places[k] = place(cells, vertex);
            highest = std::max(highest, floatH_[vertex]);
        }
        const std::optional<CellReach> reach = reachOfPyramid(places, side, 2 * kCellSlack, cells.minW);
        if (!reach) continue;
        const CellBox box{
            cellAt(reach->minX - kCellSlack, side),
            cellAt(reach->minY - kCellSlack, side),
            cellAt(reach->maxX + kCellSlack, side),
            cellAt(reach->maxY + kCellSlack, side)};
        if (context_.grid->mask(map).mayShadow(box, highest)) rasterizeTriangle(map, t, box, false);
    }
}

/// Returns the grid cells of row `row` that the triangle covers. The cells are within `box`.
CellBox ClusterCaster::rowSpan(std::size_t triangle, const CellBox& box, int row) const {
    const double low = row == box.y0 ? -std::numeric_limits<double>::infinity() : row - kCellSlack;
    const double high = row == box.y1 ? std::numeric_limits<double>::infinity() : row + 1 + kCellSlack;
    double min = std::numeric_limits<double>::infinity();
    double max = -min;
    for (std::size_t k = 0; k < 3; ++k) {
        auto i = static_cast<std::size_t>(corner_[k][triangle]);
        auto j = static_cast<std::size_t>(corner_[(k + 1) % 3][triangle]);
        if (y_[i] > y_[j]) std::swap(i, j);
        if (y_[j] < low || y_[i] > high) continue;
        const double height = y_[j] - y_[i];
        const double slope = height > 0 ? (x_[j] - x_[i]) / height : 0;
        const double p = y_[i] >= low ? x_[i] : x_[i] + (low - y_[i]) * slope;
        const double q = y_[j] <= high ? x_[j] : x_[i] + (high - y_[i]) * slope;
        min = std::min({min, p, q});
        max = std::max({max, p, q});
    }
    const int side = context_.grid->side();
    return {
        std::max(box.x0, cellAt(min - kCellSlack, side)), row, std::min(box.x1, cellAt(max + kCellSlack, side)), row};
}

/// Prepares `test` for triangle `triangle` of the cluster. Returns false if the triangle's plane is parallel to the
/// light direction.
bool ClusterCaster::prepare(std::size_t triangle, TriangleTest& test) const {
    const auto corner = [&](std::size_t k) { return sheared_[static_cast<std::size_t>(corner_[k][triangle])].data(); };
    const auto orientation = [&] {
        const SampleSpace& space = context_.samples->space();
        return facing(cornersOf(context_, caster_, triangle), space.light) * space.shear.sign;
    };
    test.name = caster_.geometry.firstTriangleId + static_cast<std::uint32_t>(triangle);
    return test.set(corner(0), corner(1), corner(2), context_.coordinateError, orientation);
}

bool ClusterCaster::prepare(std::size_t triangle, PointTriangleTest& test) const {
    const auto corner = [&](std::size_t k) { return sheared_[static_cast<std::size_t>(corner_[k][triangle])].data(); };
    const glm::i64vec3& light = *context_.samples->space().pointLight;
    // The sample test needs the sign of n . (A - L), but facingPoint returns the sign of n . (L - A).
    const auto orientation = [&] { return -facingPoint(cornersOf(context_, caster_, triangle), light); };
    test.name = caster_.geometry.firstTriangleId + static_cast<std::uint32_t>(triangle);
    return test.set(corner(0), corner(1), corner(2), glm::dvec3(light), context_.coordinateError, orientation);
}

void ClusterCaster::rasterizeTriangle(std::size_t map, std::size_t triangle, const CellBox& box, bool isNarrowed) {
    ++counts_.trianglesRasterized;
    if (context_.samples->space().pointLight)
        rasterizeTriangleAs<PointTriangleTest>(map, triangle, box, isNarrowed);
    else
        rasterizeTriangleAs<TriangleTest>(map, triangle, box, isNarrowed);
}

/// Returns true if doubles prove that the sample at index `place` lies in the plane of the tested triangle. The
/// triangle then casts no shadow on the sample.
bool ClusterCaster::isHitAtOnce(const PointTriangleTest& test, std::size_t place) const {
    return test.surelyHolds(ownCorners(context_, place));
}

void ClusterCaster::resolve(std::size_t triangle, std::size_t place, bool mayCast) {
    counts_.exactDecisions += static_cast<std::uint64_t>(mayCast);
    const std::uint8_t bits = resolveExactly(context_, caster_, triangle, place);
    if (bits != kLit) mark(context_.statuses[place], bits);
}

float ClusterCaster::highestOf(std::size_t triangle) const {
    const auto h = [&](std::size_t k) { return floatH_[static_cast<std::size_t>(corner_[k][triangle])]; };
    return std::max({h(0), h(1), h(2)});
}

/// Returns true if no sample of [begin, end) is below `highest`, the largest height h of a triangle. The triangle then
/// casts no shadow on these samples. Returns false for a point light. Also returns false for kMinBlockSamples or more
/// samples, because testBlocks tests the heights of whole boxes of samples.
template <class Test>
bool ClusterCaster::isBelowAll(std::size_t begin, std::size_t end, float highest) const {
    if (!std::is_same_v<Test, TriangleTest> || end - begin >= kMinBlockSamples) return false;
    const auto max = constant(highest);
    for (std::size_t i = begin; i < end; i += hn::Lanes(kDoubles)) {
        const auto isAbove = hn::Ge(hn::LoadU(kDoubles, &context_.samples->h[i]), max);
        if (!hn::AllTrue(kDoubles, hn::Or(isAbove, hn::Not(hn::FirstN(kDoubles, end - i))))) return false;
    }
    return true;
}

/// Tests the triangle against the samples [begin, end). The first long range prepares `blocks`, and later ranges of the
/// same triangle reuse it.
template <class Test>
void ClusterCaster::testSpan(
    std::size_t triangle, const Test& test, std::optional<BlockTest>& blocks, std::size_t begin, std::size_t end) {
    counts_.sampleTests += end - begin;
    const auto resolveOpen = [&](std::size_t place, bool mayCast) {
        if (!isHitAtOnce(test, place)) resolve(triangle, place, mayCast);
    };
    if constexpr (std::is_same_v<Test, TriangleTest>) {
        if (end - begin >= kMinBlockSamples) {
            if (!blocks) blocks.emplace(test, context_);
            return testBlocks(*blocks, test, context_, begin, end, resolveOpen);
        }
    }
    testSamples(test, context_, begin, end, resolveOpen);
}

template <class Test>
void ClusterCaster::rasterizeTriangleAs(std::size_t map, std::size_t triangle, const CellBox& box, bool isNarrowed) {
    const SampleGrid& grid = *context_.grid;
    Test test;
    std::optional<BlockTest> blocks;
    const float highest = highestOf(triangle);
    bool isSet = false;
    for (int row = box.y0; row <= box.y1; ++row) {
        std::size_t begin = grid.first(map, box.x0, row);
        std::size_t end = grid.first(map, box.x1 + 1, row);
        if (begin == end) continue;
        if (isNarrowed && end - begin > 8 && box.x1 - box.x0 > 1 && box.y1 > box.y0) {
            const CellBox span = rowSpan(triangle, box, row);
            if (span.empty()) continue;
            begin = grid.first(map, span.x0, row);
            end = grid.first(map, span.x1 + 1, row);
            if (begin == end) continue;
        }
        if (isBelowAll<Test>(begin, end, highest)) {
            counts_.sampleTests += end - begin;
            continue;
        }
        if (!isSet && !prepare(triangle, test)) return;
        isSet = true;
        testSpan(triangle, test, blocks, begin, end);
    }
}

void rasterizeClusterInLanes(const CasterContext& context, std::size_t caster, CasterCounts& counts) {
    ClusterCaster(context, caster, counts).rasterize();
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::exact {

HWY_EXPORT(rasterizeClusterInLanes);

CasterCounts& CasterCounts::operator+=(const CasterCounts& other) {
    clustersTested += other.clustersTested;
    clustersKept += other.clustersKept;
    triangles += other.triangles;
    trianglesRasterized += other.trianglesRasterized;
    sampleTests += other.sampleTests;
    exactDecisions += other.exactDecisions;
    return *this;
}

void rasterizeCluster(const CasterContext& context, std::size_t caster, CasterCounts& counts) {
    HWY_DYNAMIC_DISPATCH(rasterizeClusterInLanes)(context, caster, counts);
}

Corners cornersOf(const CasterContext& context, const Caster& caster, std::size_t triangle) {
    Corners corners;
    const std::size_t stride = caster.geometry.positionStride / sizeof(std::uint32_t);
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t* position = caster.geometry.positions + caster.geometry.triangles[triangle][k] * stride;
        for (int axis = 0; axis < 3; ++axis)
            corners[k][axis] = static_cast<std::int32_t>(position[axis] - context.originCell[axis]);
    }
    return corners;
}

Corners ownCorners(const CasterContext& context, std::size_t place) {
    constexpr unsigned kTriangleBits = 8;
    const std::uint32_t own = context.grid->triangle[place];
    return cornersOf(context, context.casters[own >> kTriangleBits], own & (raster::kMaxClusterTriangles - 1));
}

std::uint8_t resolveExactly(
    const CasterContext& context, const Caster& caster, std::size_t triangle, std::size_t place) {
    const SampleList& samples = *context.samples;
    const std::size_t sample = context.grid->source[place];
    const PointOnTriangle point{ownCorners(context, place), samples.second[sample], samples.third[sample]};
    const Corners corners = cornersOf(context, caster, triangle);
    const SampleSpace& space = samples.space();
    const RayHit hit = space.pointLight
                           ? intersectTowards(corners, *space.pointLight, scaledPoint(point))
                           : intersect(corners, space.light, scaledPoint(point), samples.tolerance[sample]);
    if (hit.kind == Hit::None) return kLit;
    if (hit.kind == Hit::WithinTolerance) return kWithinTolerance;
    return hit.isOnEdge ? kDarkByEdge : kDark;
}

} // namespace gnomon::exact
#endif
