#include "lod/error_rule.h"

#include "core/check.h"

#include <cmath>

namespace gnomon::lod {
namespace {

bool touches(const ConvexVolume& volume, const Sphere& sphere) {
    return std::all_of(volume.planes.begin(), volume.planes.end(), [&](const Plane& plane) {
        return plane.signedDistance(sphere.center) >= -sphere.radius;
    });
}

/// A range of the parameter t of a ray.
struct Interval {
    double first = 0;
    double last = std::numeric_limits<double>::infinity();

    bool isEmpty() const { return first > last; }
};

/// Returns the part of the ray `origin + t direction`, t >= 0, that is inside `volume` enlarged by `margin` on all
/// sides.
Interval clippedRay(const ConvexVolume& volume, double margin, const glm::dvec3& origin, const glm::dvec3& direction) {
    Interval result;
    for (const Plane& plane : volume.planes) {
        const double start = plane.signedDistance(origin) + margin;
        const double slope = glm::dot(plane.normal, direction);
        if (slope > 0) {
            result.first = std::max(result.first, -start / slope);
        } else if (slope < 0) {
            result.last = std::min(result.last, start / -slope);
        } else if (start < 0) {
            result.last = -1;
        }
    }
    return result;
}

} // namespace

ConvexVolume viewPyramid(const DetailView& view) {
    const CameraBasis& basis = view.basis;
    ConvexVolume pyramid;
    for (const glm::dvec3& inward :
         {basis.view * view.tanHalfX + basis.right,
          basis.view * view.tanHalfX - basis.right,
          basis.view * view.tanHalfY + basis.up,
          basis.view * view.tanHalfY - basis.up,
          basis.view}) {
        const glm::dvec3 normal = glm::normalize(inward);
        pyramid.planes.push_back({normal, -glm::dot(normal, view.eye)});
    }
    return pyramid;
}

double TexelWidth::smallerSide(double zeta) const {
    const double stretch = 1 + kappa * std::clamp(zeta, 0.0, depth);
    const double along = isLog ? length * stretch : length * stretch * stretch / (1 + kappa * depth);
    return std::min(width * stretch, along);
}

ErrorRule::ErrorRule(const DetailView& view) : ErrorRule(view, {}) {}

ErrorRule::ErrorRule(const DetailView& view, std::vector<CasterDetail> casters)
    : view_(view),
      pyramid_(viewPyramid(view)),
      pixelsPerUnit_(view.pixelsPerUnit()),
      edgePixelsPerUnit_(view.edgePixelsPerUnit()),
      cornerCosine_(1 / std::sqrt(1 + view.tanHalfX * view.tanHalfX + view.tanHalfY * view.tanHalfY)),
      casters_(std::move(casters)) {
    GNOMON_CHECK(view.nearestDepth > 0 && view.tanHalfX > 0 && view.tanHalfY > 0);
}

double ErrorRule::viewPixels(const Sphere& bounds, double error) const {
    if (!(error > 0) || !touches(pyramid_, bounds)) return 0;
    const glm::dvec3 toCenter = bounds.center - view_.eye;
    const double depth = glm::dot(toCenter, view_.basis.view);
    const double squaredDistance = glm::dot(toCenter, toCenter);
    // Squared length of a tangent from the eye to the bounding sphere.
    const double squaredTangent = squaredDistance - bounds.radius * bounds.radius;
    double cosine = cornerCosine_;
    if (depth > 0 && squaredTangent > 0) {
        // cos(phi + asin(r / |p|)) is the cosine of the largest angle between the view axis and a point of the sphere.
        const double across = std::sqrt(std::max(0.0, squaredDistance - depth * depth));
        cosine = std::max(cosine, (depth * std::sqrt(squaredTangent) - across * bounds.radius) / squaredDistance);
    }
    return error * pixelsPerUnit_ / (std::max(depth - bounds.radius, view_.nearestDepth) * cosine);
}

double ErrorRule::minViewPixels(const Box& box, double error) const {
    if (classify(pyramid_, box) != Containment::Inside) return 0;
    // Each sphere that contains a point of the box extends at least to the farthest point of the box. The angle to the
    // view axis is ignored, because it can only increase the result.
    constexpr double kRoundedUp = 1 - 1e-6; // spheres and the geometry in them are rounded separately
    const glm::dvec3& view = view_.basis.view;
    const double middle = glm::dot(box.center() - view_.eye, view);
    const double farthest = middle + 0.5 * glm::dot(glm::abs(view), box.extent());
    return kRoundedUp * error * pixelsPerUnit_ / std::max(farthest, view_.nearestDepth);
}

double ErrorRule::maxViewPixels(const Box& box, double error) const {
    const Box reach{box.min - error, box.max + error}; // contains both the drawn geometry and its refinement
    if (!(error > 0) || classify(pyramid_, reach) == Containment::Outside) return 0;
    const glm::dvec3& view = view_.basis.view;
    const double middle = glm::dot(reach.center() - view_.eye, view);
    const double nearest = middle - 0.5 * glm::dot(glm::abs(view), reach.extent());
    // The angle of a visible point to the view axis is at most the angle of the image corner. The geometry moves by at
    // most `error` from the visible point.
    const double depth = std::max(nearest, distance(box, view_.eye) * cornerCosine_ - error);
    const double across = view_.heightPixels * std::hypot(1.0, view_.tanHalfX / view_.tanHalfY);
    return std::min(across, error * pixelsPerUnit_ / (std::max(depth, view_.nearestDepth) * cornerCosine_));
}

double ErrorRule::casterPixels(const Sphere& bounds, double error, double floor) const {
    if (casters_.empty() || !(error > 0)) return 0;
    double pixels = floor;
    for (const CasterDetail& caster : casters_) {
        // a point light can magnify the displacement of the shadow beyond the bound below
        const bool isBounded = !caster.point;
        if (isBounded && error * edgePixelsPerUnit_ / caster.receiverNear <= pixels) continue;
        pixels = std::max(pixels, oneCasterPixels(caster, bounds, error));
    }
    return pixels;
}

double ErrorRule::oneCasterPixels(const CasterDetail& caster, const Sphere& bounds, double error) const {
    if (!touches(caster.casters, bounds)) return 0;
    if (caster.point) {
        // min distance to the light, as a fraction of the distance to the farthest receiver
        constexpr double kNearest = 1e-6;
        const double from = glm::length(bounds.center - caster.point->at) - bounds.radius;
        const double growth = std::max(1.0, caster.point->farthest / std::max(from, kNearest * caster.point->farthest));
        return error * growth * edgePixelsPerUnit_ / caster.receiverNear;
    }
    const TexelWidth& texel = caster.texel;
    const double zeta = glm::dot(texel.axis, bounds.center) - texel.origin;
    if (error <= 0.5 * texel.smallerSide(zeta - bounds.radius)) return 0;
    const Interval ray = clippedRay(caster.receivers, bounds.radius, bounds.center, -caster.towardsLight);
    if (ray.isEmpty()) return 0;
    const double start = glm::dot(bounds.center - view_.eye, view_.basis.view);
    const double slope = -glm::dot(caster.towardsLight, view_.basis.view);
    const double nearest = start + slope * (slope > 0 ? ray.first : ray.last) - bounds.radius;
    return error * edgePixelsPerUnit_ / std::max(slope == 0 ? start - bounds.radius : nearest, caster.receiverNear);
}

} // namespace gnomon::lod
