#include "render/ray_pass.h"

#include "render/view/section_cut.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

/// Returns the corners of `triangle`, in cells from the frame's origin. `vertices` are the vertices of its cluster.
exact::Corners cornersOf(
    const DrawInputs& frame, const hierarchy::Vertex* vertices, const hierarchy::Triangle& triangle) {
    const hierarchy::GridPoint& origin = frame.space.originCell;
    exact::Corners corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const hierarchy::GridPoint& p = vertices[triangle[k]].position;
        // Unsigned subtraction wraps modulo 2^32. The cast then gives the correct signed difference, even for
        // positions outside the grid.
        corners[k] = glm::ivec3(
            static_cast<std::int32_t>(p.x - origin.x),
            static_cast<std::int32_t>(p.y - origin.y),
            static_cast<std::int32_t>(p.z - origin.z));
    }
    return corners;
}

/// A rule for ray tracing: a ray ignores the triangle on which it starts, and all triangles in the same plane.
class PlaneRule final : public raytrace::HitRule {
public:
    PlaneRule(const DrawInputs& frame, const exact::SampleList& samples, std::span<const DrawnCluster> drawn)
        : frame_(&frame), samples_(&samples), drawn_(drawn) {}

    bool stops(std::uint32_t ray, const raytrace::PageTriangle& hit) const override {
        const std::uint32_t name = samples_->triangle[ray];
        const DrawnCluster& own = drawn_[name >> kTriangleBits];
        const std::uint32_t ownTriangle = name & (raster::kMaxClusterTriangles - 1);
        if (hit.page == own.pageId && hit.cluster == own.cluster && hit.triangle == ownTriangle) return false;
        const hierarchy::Page& page = frame_->pages(hit.page);
        const hierarchy::Cluster& cluster = page.clusters[hit.cluster];
        const exact::Corners corners = cornersOf(
            *frame_, &page.vertices[cluster.firstVertex], page.triangles[cluster.firstTriangle + hit.triangle]);
        const exact::PointOnTriangle point{
            cornersOf(*frame_, own.vertices, own.triangles[ownTriangle]), samples_->second[ray], samples_->third[ray]};
        return !exact::isInPlane(corners, exact::scaledPoint(point));
    }

private:
    const DrawInputs* frame_;
    const exact::SampleList* samples_;
    std::span<const DrawnCluster> drawn_;
};

/// Returns the ray from sample `i` to the light, in grid cells. The direction of a directional light is exact: the ray
/// parameter 1 is 2^-24 of the light's integer direction. The direction to a point light has unit length, and the ray
/// ends at the light.
raytrace::Ray rayOf(const exact::SampleList& samples, std::size_t i, std::span<const Plane> sections) {
    const exact::SampleSpace& space = samples.space();
    const exact::LightShear& shear = space.shear;
    const double along = shear.sign * samples.h[i];
    glm::dvec3 origin(0);
    origin[shear.along] = along;
    origin[shear.first] = samples.u[i] + shear.firstRatio * along;
    origin[shear.second] = samples.v[i] + shear.secondRatio * along;
    raytrace::Ray ray;
    ray.origin = glm::vec3(origin);
    if (space.pointLight) {
        const glm::dvec3 towards = glm::dvec3(*space.pointLight) - origin;
        constexpr double kTolerance = 2; // in cells
        ray.direction = glm::vec3(glm::normalize(towards));
        ray.tMin = static_cast<float>(kTolerance);
        ray.tMax = static_cast<float>(glm::length(towards));
    } else {
        ray.direction = glm::vec3(glm::dvec3(space.light.direction) * std::ldexp(1.0, -kLightBits));
        ray.tMin = static_cast<float>(samples.tolerance[i]);
    }
    const glm::dvec3 direction(ray.direction);
    for (const Plane& plane : sections) { // removed geometry throws no shadow, so the ray ends at the section planes
        const double slope = glm::dot(plane.normal, direction);
        if (slope >= 0) continue;
        const double end = std::max(plane.signedDistance(origin), 0.0) / -slope;
        ray.tMax = std::min(ray.tMax, static_cast<float>(end));
    }
    return ray;
}

} // namespace

std::vector<std::uint8_t> tracedStatuses(
    const DrawInputs& frame,
    const raytrace::CutScene& scene,
    const exact::SampleList& samples,
    std::span<const DrawnCluster> drawn) {
    constexpr std::size_t kPerTask = 1024;
    const PlaneRule rule(frame, samples, drawn);
    const std::vector<Plane> sections = frame.plan->view.cutsCasters ? sectionPlanes(frame) : std::vector<Plane>();
    std::vector<std::uint8_t> statuses(samples.size(), exact::kLit);
    tbb::parallel_for(std::size_t{0}, (samples.size() + kPerTask - 1) / kPerTask, [&](std::size_t task) {
        for (std::size_t i = task * kPerTask; i < std::min(samples.size(), (task + 1) * kPerTask); ++i)
            if (scene.isStopped(rayOf(samples, i, sections), static_cast<std::uint32_t>(i), rule))
                statuses[i] = exact::kDark;
    });
    return statuses;
}

} // namespace gnomon::render
