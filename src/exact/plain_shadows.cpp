#include "exact/plain_shadows.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::exact {

namespace {

/// A triangle and the bounding box of its shadow on the light plane. The box is enlarged by one cell on each side,
/// which exceeds every rounding error.
struct PlainTriangle {
    Corners corners{};
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};
    std::uint32_t name = 0;
};

/// A grid of square buckets on the light plane, for finding triangles. The outermost buckets also contain the triangles
/// outside the grid.
class Buckets {
public:
    Buckets(const glm::dvec2& min, const glm::dvec2& max)
        : min_(min), perCell_(glm::dvec2(kSide) / glm::max(max - min, glm::dvec2(1))), lists_(kSide * kSide) {}

    void add(const PlainTriangle& triangle, std::uint32_t index) {
        for (std::size_t y = row(triangle.min.y); y <= row(triangle.max.y); ++y)
            for (std::size_t x = column(triangle.min.x); x <= column(triangle.max.x); ++x)
                lists_[y * kSide + x].push_back(index);
    }

    std::span<const std::uint32_t> at(double u, double v) const { return lists_[row(v) * kSide + column(u)]; }

private:
    static constexpr std::size_t kSide = 256;

    static std::size_t bucket(double x) {
        return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, static_cast<double>(kSide - 1)));
    }

    std::size_t column(double u) const { return bucket((u - min_.x) * perCell_.x); }

    std::size_t row(double v) const { return bucket((v - min_.y) * perCell_.y); }

    glm::dvec2 min_;
    glm::dvec2 perCell_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

PlainTriangle plainTriangle(const Corners& corners, const LightShear& shear) {
    PlainTriangle result{corners};
    for (const glm::i64vec3& corner : corners) {
        const glm::dvec3 p(corner);
        const glm::dvec2 place(
            p[shear.first] - shear.firstRatio * p[shear.along], p[shear.second] - shear.secondRatio * p[shear.along]);
        result.min = glm::min(result.min, place - 1.0);
        result.max = glm::max(result.max, place + 1.0);
    }
    return result;
}

/// The casters for exact shadows by brute force.
struct PlainScene {
    const CasterContext& context;
    std::span<const Caster> casters;
    const std::vector<PlainTriangle>& triangles;
    const Buckets& buckets;
};

std::uint8_t plainStatus(const SampleList& samples, std::size_t i, const PlainScene& scene) {
    constexpr unsigned kTriangleBits = 8;
    const std::uint32_t own = samples.triangle[i];
    const PointOnTriangle point{
        cornersOf(scene.context, scene.casters[own >> kTriangleBits], own & (raster::kMaxClusterTriangles - 1)),
        samples.second[i],
        samples.third[i]};
    const glm::i64vec3 scaled = scaledPoint(point);
    const double u = samples.u[i];
    const double v = samples.v[i];
    std::uint8_t status = kLit;
    for (const std::uint32_t t : scene.buckets.at(u, v)) {
        const PlainTriangle& triangle = scene.triangles[t];
        // A sample does not shadow itself: if a section plane cut its triangle, rounding may move the sample off the
        // plane of the triangle.
        if (triangle.name == own) continue;
        if (u < triangle.min.x || v < triangle.min.y || u > triangle.max.x || v > triangle.max.y) continue;
        const RayHit hit = intersect(triangle.corners, samples.space().light, scaled, samples.tolerance[i]);
        if (hit.kind == Hit::None) continue;
        status |= hit.kind == Hit::WithinTolerance ? kWithinTolerance : hit.isOnEdge ? kDarkByEdge : kDark;
        if ((status & kDark) != 0) return kDark;
    }
    return status;
}

} // namespace

std::vector<std::uint8_t> plainStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested) {
    if (samples.space().pointLight) return plainPointStatuses(samples, casters, originCell, isRequested);
    std::vector<std::uint8_t> statuses(samples.size(), kLit);
    if (samples.size() == 0) return statuses;
    glm::dvec2 min(samples.u[0], samples.v[0]);
    glm::dvec2 max = min;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        min = glm::min(min, glm::dvec2(samples.u[i], samples.v[i]));
        max = glm::max(max, glm::dvec2(samples.u[i], samples.v[i]));
    }
    CasterContext context;
    context.originCell = originCell;
    std::vector<PlainTriangle> triangles;
    Buckets buckets(min, max);
    for (const Caster& caster : casters) {
        // A caster without vertices casts no shadow. It only contains triangles on which samples lie.
        if (caster.geometry.vertexCount == 0) continue;
        for (std::size_t t = 0; t < caster.geometry.triangles.size(); ++t) {
            PlainTriangle triangle = plainTriangle(cornersOf(context, caster, t), samples.space().shear);
            triangle.name = caster.geometry.firstTriangleId + static_cast<std::uint32_t>(t);
            if (triangle.max.x < min.x || triangle.max.y < min.y || triangle.min.x > max.x || triangle.min.y > max.y)
                continue;
            buckets.add(triangle, static_cast<std::uint32_t>(triangles.size()));
            triangles.push_back(triangle);
        }
    }
    const PlainScene scene{context, casters, triangles, buckets};
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        if (isRequested.empty() || isRequested[i] != 0) statuses[i] = plainStatus(samples, i, scene);
    });
    return statuses;
}

} // namespace gnomon::exact
