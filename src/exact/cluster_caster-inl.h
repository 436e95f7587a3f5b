// Tests one cluster of casters against the samples of exact shadows. First the receiver mask of each map can cull the
// cluster. Corners are in the sheared light space, or relative to a point light. The header is compiled once per SIMD
// instruction set.
#if defined(GNOMON_EXACT_CLUSTER_CASTER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_EXACT_CLUSTER_CASTER_INL_H
#undef GNOMON_EXACT_CLUSTER_CASTER_INL_H
#else
#define GNOMON_EXACT_CLUSTER_CASTER_INL_H
#endif

#include "exact/blocks/block_test-inl.h"
#include "exact/caster_context.h"
#include "exact/float_rounding.h"
#include "exact/point_span_test-inl.h"
#include "exact/span_test-inl.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace gnomon::exact::HWY_NAMESPACE {

using FloatTag = hn::ScalableTag<float>;
using IntTag = hn::ScalableTag<std::int32_t>;
using Floats = hn::Vec<FloatTag>;
using Ints = hn::Vec<IntTag>;
constexpr FloatTag kFloats;
constexpr IntTag kInts;

constexpr std::size_t kMinBlockSamples = 32; // spans with fewer samples are faster without blocks
constexpr std::size_t kMaxVertices = raster::kMaxClusterVertices;
constexpr std::size_t kMaxTriangles = raster::kMaxClusterTriangles;

/// Tests the triangles of one cluster of casters against the samples of each map.
class ClusterCaster {
public:
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): zeroing the arrays would take longer than most clusters
    ClusterCaster(const CasterContext& context, std::size_t caster, CasterCounts& counts)
        : context_(context), caster_(context.casters[caster]), counts_(counts) {}

    void rasterize() {
        ++counts_.clustersTested;
        bool isSheared = false;
        for (std::size_t map = 0; map < context_.grid->maps().size(); ++map) {
            if (context_.grid->maps()[map].isEmpty || !mayShadow(map)) continue;
            if (!isSheared) {
                shear();
                ++counts_.clustersKept;
            }
            isSheared = true;
            counts_.triangles += caster_.geometry.triangles.size();
            rasterizeInto(map);
        }
    }

private:
    bool mayShadow(std::size_t map) const;
    bool mayShadowFromPoint(std::size_t map) const;
    bool isUnmasked(std::size_t map, const glm::dvec2& low, const glm::dvec2& high, double h) const;
    void shear();
    void findNearness(const GridMap& cells);
    void rasterizeInto(std::size_t map);
    void rasterizeWhole(std::size_t map);
    void rasterizeClipped(std::size_t map);
    void rasterizeNearLight(std::size_t map);
    glm::dvec3 place(const GridMap& cells, std::size_t vertex) const;
    bool prepare(std::size_t triangle, TriangleTest& test) const;
    bool prepare(std::size_t triangle, PointTriangleTest& test) const;

    static bool isHitAtOnce(const TriangleTest& /*test*/, std::size_t /*place*/) { return false; }

    bool isHitAtOnce(const PointTriangleTest& test, std::size_t place) const;
    void resolve(std::size_t triangle, std::size_t place, bool mayCast);
    float highestOf(std::size_t triangle) const;
    template <class Test>
    bool isBelowAll(std::size_t begin, std::size_t end, float highest) const;
    template <class Test>
    void testSpan(
        std::size_t triangle, const Test& test, std::optional<BlockTest>& blocks, std::size_t begin, std::size_t end);
    template <class Test>
    void rasterizeTriangleAs(std::size_t map, std::size_t triangle, const CellBox& box, bool isNarrowed);
    void rasterizeTriangle(std::size_t map, std::size_t triangle, const CellBox& box, bool isNarrowed);
    CellBox rowSpan(std::size_t triangle, const CellBox& box, int row) const;

    const CasterContext& context_;
    const Caster& caster_;
    CasterCounts& counts_;
    std::array<std::array<double, 3>, kMaxVertices> sheared_; // u, v, h
    std::array<double, kMaxVertices> x_, y_, w_;              // in cells of the map; valid where w is large enough
    alignas(64) std::array<float, kMaxVertices> floatX_, floatY_, floatH_;
    alignas(64) std::array<std::int32_t, kMaxTriangles> corner_[3];
};

/// Returns true if a caster may shadow a sample of `map`. The caster covers cells from `low` to `high`, and `h` is its
/// largest height towards the light.
inline bool ClusterCaster::isUnmasked(std::size_t map, const glm::dvec2& low, const glm::dvec2& high, double h) const {
    const int side = context_.grid->side();
    if (high.x < -kCellSlack || high.y < -kCellSlack || low.x > side + kCellSlack || low.y > side + kCellSlack)
        return false;
    const CellBox box{
        cellAt(low.x - kCellSlack, side),
        cellAt(low.y - kCellSlack, side),
        cellAt(high.x + kCellSlack, side),
        cellAt(high.y + kCellSlack, side)};
    return context_.grid->mask(map).mayShadow(box, roundedUp(h));
}

/// Returns true if the cluster may shadow a sample of `map`, for a point light. The test uses the cluster's box and the
/// receiver mask. If the box extends behind the light or close to it, the cluster may cover any cell.
inline bool ClusterCaster::mayShadowFromPoint(std::size_t map) const {
    const GridMap& cells = context_.grid->maps()[map];
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    int beside = 0;
    int behind = 0;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner(
            (i & 1U) != 0 ? caster_.max.x : caster_.min.x,
            (i & 2U) != 0 ? caster_.max.y : caster_.min.y,
            (i & 4U) != 0 ? caster_.max.z : caster_.min.z);
        const glm::dvec3 p = cells.cellsFromLight * glm::dvec4(corner, 1);
        behind += p.z <= 0 ? 1 : 0;
        beside += p.z < cells.minW ? 1 : 0;
        low = glm::min(low, glm::dvec2(p) / p.z);
        high = glm::max(high, glm::dvec2(p) / p.z);
    }
    if (behind == 8) return false;
    const int axis = cells.nearAxis;
    const double h = cells.nearSign * static_cast<double>(cells.nearSign > 0 ? caster_.max[axis] : caster_.min[axis]);
    if (beside == 0) return isUnmasked(map, low, high, h + context_.coordinateError);
    return isUnmasked(map, glm::dvec2(0), glm::dvec2(context_.grid->side()), h + context_.coordinateError);
}

/// Returns true if the cluster may shadow a sample of `map`. For a directional light, the test projects the four
/// corners of the cluster's shadow bounds to the map and reads the receiver mask. If w is not positive at all four
/// corners, the result is true.
inline bool ClusterCaster::mayShadow(std::size_t map) const {
    if (context_.samples->space().pointLight) return mayShadowFromPoint(map);
    const LightShear& shear = context_.samples->space().shear;
    const glm::dvec3 min(caster_.min);
    const glm::dvec3 max(caster_.max);
    const auto span = [&](int axis, double ratio) {
        const double p = ratio * min[shear.along];
        const double q = ratio * max[shear.along];
        return std::array{min[axis] - std::max(p, q), max[axis] - std::min(p, q)};
    };
    const double error = context_.coordinateError;
    const auto u = span(shear.first, shear.firstRatio);
    const auto v = span(shear.second, shear.secondRatio);
    const double h = (shear.sign > 0 ? max[shear.along] : -min[shear.along]) + error;
    const GridMap& cells = context_.grid->maps()[map];
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high(-std::numeric_limits<double>::infinity());
    for (int i = 0; i < 4; ++i) {
        const glm::dvec3 p = cells.cellsFromLight *
                             glm::dvec4(u[static_cast<std::size_t>(i & 1)], v[static_cast<std::size_t>(i >> 1)], 0, 1);
        if (p.z < cells.minW) return true;
        low = glm::min(low, glm::dvec2(p) / p.z);
        high = glm::max(high, glm::dvec2(p) / p.z);
    }
    return isUnmasked(map, low, high, h);
}

inline void ClusterCaster::shear() {
    const LightShear& shear = context_.samples->space().shear;
    const raster::Cluster& geometry = caster_.geometry;
    const std::size_t stride = geometry.positionStride / sizeof(std::uint32_t);
    const auto along = shear.along;
    for (std::size_t i = 0; i < geometry.vertexCount; ++i) {
        const std::uint32_t* position = geometry.positions + i * stride;
        const auto cell = [&](int axis) {
            return static_cast<double>(static_cast<std::int32_t>(position[axis] - context_.originCell[axis]));
        };
        const double p = cell(along);
        sheared_[i] = {
            cell(shear.first) - shear.firstRatio * p, cell(shear.second) - shear.secondRatio * p, shear.sign * p};
        floatH_[i] = roundedUp(sheared_[i][2] + context_.coordinateError);
    }
    for (std::size_t t = 0; t < geometry.triangles.size(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            corner_[k][t] = geometry.triangles[t][k];
    const std::size_t padded = (geometry.triangles.size() + 15) / 16 * 16;
    for (auto& corners : corner_)
        std::fill(
            corners.begin() + static_cast<std::ptrdiff_t>(geometry.triangles.size()),
            corners.begin() + static_cast<std::ptrdiff_t>(padded),
            0);
}

/// Computes the height of each vertex towards a point light. The height is the vertex coordinate along the axis of the
/// map's cube face.
inline void ClusterCaster::findNearness(const GridMap& cells) {
    const auto axis = static_cast<std::size_t>(cells.nearAxis);
    for (std::size_t i = 0; i < caster_.geometry.vertexCount; ++i)
        floatH_[i] = roundedUp(cells.nearSign * sheared_[i][axis] + context_.coordinateError);
}

inline glm::dvec3 ClusterCaster::place(const GridMap& cells, std::size_t vertex) const {
    const auto& [u, v, h] = sheared_[vertex];
    return cells.cellsFromLight * glm::dvec4(u, v, h, 1);
}

} // namespace gnomon::exact::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#endif // include guard
