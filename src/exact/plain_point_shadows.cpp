#include "exact/plain_shadows.h"
#include "exact/point_predicate.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {

namespace {

struct SeenTriangle {
    Corners corners{};
    std::uint32_t name = 0;
};

/// A lookup structure for the triangles around a point light: a grid of square buckets on each of the six faces of a
/// cube around the light.
class CubeBuckets {
public:
    explicit CubeBuckets(const glm::i64vec3& light) : light_(light), lists_(6 * kSide * kSide) {}

    /// Adds a triangle to each bucket that intersects the triangle's box, projected onto the cube faces.
    void add(const Corners& corners, std::uint32_t index) {
        const glm::dvec3 min(glm::min(glm::min(corners[0], corners[1]), corners[2]) - light_);
        const glm::dvec3 max(glm::max(glm::max(corners[0], corners[1]), corners[2]) - light_);
        for (int face = 0; face < 6; ++face)
            addToFace(face, min, max, index);
    }

    const std::vector<std::uint32_t>& at(const glm::dvec3& fromLight) const {
        int axis = 0;
        for (int i = 1; i < 3; ++i)
            if (std::abs(fromLight[i]) > std::abs(fromLight[axis])) axis = i;
        const double far = std::abs(fromLight[axis]);
        const int face = 2 * axis + (fromLight[axis] < 0 ? 1 : 0);
        return lists_[place(face, bucket(fromLight[(axis + 1) % 3] / far), bucket(fromLight[(axis + 2) % 3] / far))];
    }

private:
    static constexpr std::size_t kSide = 128;
    static constexpr double kSlack = 1e-9; // larger than the rounding error of projected positions

    void addToFace(int face, const glm::dvec3& min, const glm::dvec3& max, std::uint32_t index) {
        const int axis = face / 2;
        const double near = face % 2 == 0 ? min[axis] : -max[axis];
        const double far = face % 2 == 0 ? max[axis] : -min[axis];
        if (far <= 0) return;
        const auto span = [&](int k) {
            if (near <= 0) return std::array<std::size_t, 2>{0, kSide - 1};
            const double low = min[k] / (min[k] < 0 ? near : far);
            const double high = max[k] / (max[k] > 0 ? near : far);
            return std::array{bucket(low - kSlack), bucket(high + kSlack)};
        };
        const auto [x0, x1] = span((axis + 1) % 3);
        const auto [y0, y1] = span((axis + 2) % 3);
        for (std::size_t y = y0; y <= y1; ++y)
            for (std::size_t x = x0; x <= x1; ++x)
                lists_[place(face, x, y)].push_back(index);
    }

    /// Returns the index of the bucket that contains the coordinate `x`. Coordinates outside [-1, 1] belong to the
    /// outermost buckets.
    static std::size_t bucket(double x) {
        const double cells = std::floor((x + 1) / 2 * static_cast<double>(kSide));
        return static_cast<std::size_t>(std::clamp(cells, 0.0, static_cast<double>(kSide - 1)));
    }

    static std::size_t place(int face, std::size_t x, std::size_t y) {
        return (static_cast<std::size_t>(face) * kSide + y) * kSide + x;
    }

    glm::i64vec3 light_;
    std::vector<std::vector<std::uint32_t>> lists_;
};

/// All triangles that can cast shadows from a point light.
struct SeenScene {
    explicit SeenScene(const glm::i64vec3& from) : light(from), buckets(from) {}

    void add(const Caster& caster, const CasterContext& context) {
        // A caster without vertices casts no shadow. It only contains triangles on which samples lie.
        if (caster.geometry.vertexCount == 0) return;
        for (std::size_t t = 0; t < caster.geometry.triangles.size(); ++t) {
            const Corners corners = cornersOf(context, caster, t);
            buckets.add(corners, static_cast<std::uint32_t>(triangles.size()));
            triangles.push_back({corners, caster.geometry.firstTriangleId + static_cast<std::uint32_t>(t)});
        }
    }

    /// Returns the shadow result of `point`, which lies on the triangle with the id `own`.
    std::uint8_t statusOf(const PointOnTriangle& point, std::uint32_t own) const {
        const glm::i64vec3 scaled = scaledPoint(point);
        const std::optional<PointRay> ray = rayToPoint(light, scaled);
        if (!ray) return kLit;
        const glm::dvec3 fromLight = glm::dvec3(scaled) * 0x1p-24 - glm::dvec3(light);
        std::uint8_t status = kLit;
        for (const std::uint32_t t : buckets.at(fromLight)) {
            // A sample does not shadow itself: if a section plane cut its triangle, rounding may move the sample off
            // the plane of the triangle.
            if (triangles[t].name == own) continue;
            const RayHit hit = intersectTowards(triangles[t].corners, light, scaled, *ray);
            if (hit.kind == Hit::None) continue;
            status |= hit.kind == Hit::WithinTolerance ? kWithinTolerance : hit.isOnEdge ? kDarkByEdge : kDark;
            if ((status & kDark) != 0) return kDark;
        }
        return status;
    }

    glm::i64vec3 light;
    std::vector<SeenTriangle> triangles;
    CubeBuckets buckets;
};

} // namespace

std::vector<std::uint8_t> plainPointStatuses(
    const SampleList& samples,
    std::span<const Caster> casters,
    const glm::uvec3& originCell,
    std::span<const std::uint8_t> isRequested) {
    constexpr unsigned kTriangleBits = 8;
    CasterContext context;
    context.originCell = originCell;
    SeenScene scene(*samples.space().pointLight);
    for (const Caster& caster : casters)
        scene.add(caster, context);
    std::vector<std::uint8_t> statuses(samples.size(), kLit);
    tbb::parallel_for(std::size_t{0}, samples.size(), [&](std::size_t i) {
        if (!isRequested.empty() && isRequested[i] == 0) return;
        const std::uint32_t own = samples.triangle[i];
        const Corners corners =
            cornersOf(context, casters[own >> kTriangleBits], own & (raster::kMaxClusterTriangles - 1));
        statuses[i] = scene.statusOf({corners, samples.second[i], samples.third[i]}, own);
    });
    return statuses;
}

} // namespace gnomon::exact
