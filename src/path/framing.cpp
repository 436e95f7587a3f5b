#include "path/framing.h"

#include "core/box.h"
#include "hierarchy/upright_frame.h"

#include <cmath>
#include <vector>

namespace gnomon::path {

namespace {

constexpr glm::dvec3 kUprightLight(0.4, 1, 0.3);
constexpr double kAside = 0.45;     // three-quarter view: tangent of the sideways angle
constexpr double kFromAbove = 0.45; // three-quarter view: tangent of the angle from above
constexpr double kClosest = 0.02;   // min distance from the eye to the model, as a fraction of the model's size

/// The range of the picture along one axis, as tangents of the view angle.
struct Extent {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    void add(double tangent) {
        min = std::min(min, tangent);
        max = std::max(max, tangent);
    }

    double middle() const { return 0.5 * (min + max); }
};

/// The position of the eye, along one axis of the picture, at which `points` (camera space) exactly fill the range of
/// `tangent`. `depth` is its coordinate along the view direction, and `aside` is the sideways one.
struct Fit {
    double depth = 0;
    double aside = 0;
};

Fit fitAlong(std::span<const glm::dvec3> points, int axis, double tangent) {
    // With the eye at (ex, ez), a point (x, z) is inside one border of the picture if x - tx z <= ex - tx ez. It is
    // inside the other border if -x - tx z <= -ex - tx ez.
    double right = -std::numeric_limits<double>::infinity();
    double left = right;
    for (const glm::dvec3& p : points) {
        right = std::max(right, p[axis] - tangent * p.z);
        left = std::max(left, -p[axis] - tangent * p.z);
    }
    return {-(right + left) / (2 * tangent), 0.5 * (right - left)};
}

/// Returns the sideways position of an eye at `depth` that centres `points` along an axis of the picture.
double centerAlong(std::span<const glm::dvec3> points, int axis, double depth) {
    Extent sides;
    for (const glm::dvec3& p : points)
        sides.add(p[axis]);
    double low = sides.min;
    double high = sides.max;
    constexpr int kHalvings = 40;
    for (int i = 0; i < kHalvings; ++i) {
        const double aside = 0.5 * (low + high);
        Extent seen;
        for (const glm::dvec3& p : points)
            seen.add((p[axis] - aside) / (p.z - depth));
        (seen.middle() > 0 ? low : high) = aside;
    }
    return 0.5 * (low + high);
}

/// Transforms `direction` from upright space, in which y is up, to world space and normalises it.
glm::dvec3 unit(const hierarchy::UprightFrame& frame, const glm::dvec3& direction) {
    return glm::normalize(frame.toWorld(direction));
}

} // namespace

Vantage vantageOf(const std::optional<ViewSide>& side, const glm::dvec3& up) {
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(up);
    if (!side) {
        const glm::dvec3 level = glm::normalize(glm::dvec3(kAside, 0, 1));
        return {unit(frame, level + glm::dvec3(0, kFromAbove, 0)), frame.up};
    }
    switch (*side) {
    case ViewSide::Front:
        return {frame.front, frame.up};
    case ViewSide::Back:
        return {-frame.front, frame.up};
    case ViewSide::Left:
        return {-frame.right, frame.up};
    case ViewSide::Right:
        return {frame.right, frame.up};
    case ViewSide::Top:
        return {frame.up, -frame.front};
    case ViewSide::Bottom:
        return {-frame.up, frame.front};
    case ViewSide::Iso:
        break;
    }
    return {unit(frame, glm::dvec3(1)), frame.up};
}

glm::dvec3 usualLight(const glm::dvec3& up) {
    return hierarchy::uprightFrame(up).toWorld(kUprightLight);
}

Camera framingCamera(std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians) {
    Box box;
    for (const glm::dvec3& point : points)
        box.add(point);
    const glm::dvec3 center = box.center();
    const CameraBasis basis = cameraBasis({center + vantage.from, center, vantage.up, fovYRadians});
    std::vector<glm::dvec3> seen;
    seen.reserve(points.size());
    double nearest = 0;
    for (const glm::dvec3& point : points) {
        seen.push_back(toCamera(basis, point - center));
        nearest = std::min(nearest, seen.back().z);
    }
    const double tangentY = kFramedPart * std::tan(fovYRadians / 2);
    const Fit wide = fitAlong(seen, 0, aspect * tangentY);
    const Fit high = fitAlong(seen, 1, tangentY);
    // Limits how near the eye comes. The tip of a slender object would otherwise touch the eye before the rest fills
    // the picture.
    const double closest = nearest - kClosest * std::max(glm::length(box.extent()), 1e-12);
    const double depth = std::min({wide.depth, high.depth, closest});
    const glm::dvec3 eye(
        depth == wide.depth ? wide.aside : centerAlong(seen, 0, depth),
        depth == high.depth ? high.aside : centerAlong(seen, 1, depth),
        depth);
    // The target is the point of the view axis nearest to the vertical line through the middle of the model, unless
    // this point is far away.
    const glm::dvec3 upright = toCamera(basis, vantage.up);
    const double along = 1 - upright.z * upright.z;
    const double overshoot = (glm::dot(eye, upright) * upright.z - depth) / along;
    const bool isNear = overshoot > -0.25 * depth && overshoot < -4 * depth;
    const glm::dvec3 target = eye + glm::dvec3(0, 0, isNear ? overshoot : -depth);
    return {center + toWorld(basis, eye), center + toWorld(basis, target), vantage.up, fovYRadians};
}

Camera orthographicFraming(
    std::span<const glm::dvec3> points, const Vantage& vantage, double aspect, double fovYRadians) {
    Box world;
    for (const glm::dvec3& point : points)
        world.add(point);
    const CameraBasis basis = cameraBasis({world.center() + vantage.from, world.center(), vantage.up, fovYRadians});
    Box seen;
    for (const glm::dvec3& point : points)
        seen.add(toCamera(basis, point - world.center()));
    const double size = std::max(glm::length(world.extent()), 1e-12);
    const double height = std::max(seen.extent().y, seen.extent().x / aspect) / kFramedPart;
    const double halfHeight = 0.5 * std::max(height, kClosest * size);
    const glm::dvec3 target = world.center() + toWorld(basis, seen.center());
    const glm::dvec3 eye = target + vantage.from * (halfHeight / std::tan(fovYRadians / 2));
    return {eye, target, vantage.up, fovYRadians, Projection::Orthographic};
}

} // namespace gnomon::path
