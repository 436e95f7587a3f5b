#include "path/suited_path.h"

#include "hierarchy/main_part.h"
#include "hierarchy/upright_frame.h"
#include "path/drawn_triangles.h"
#include "path/model_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::path {

namespace {

constexpr double kDuration = 12; // seconds
constexpr double kTwoPi = 6.283185307179586;

/// Returns a camera path on a circle around the model, slightly from above.
CameraPath orbit(const Box& bounds) {
    CameraPath path;
    path.loop = true;
    path.interpolation = Interpolation::CatmullRom;
    const glm::dvec3 center = bounds.center();
    const double radius = 0.95 * glm::length(bounds.extent());
    constexpr int kKeys = 16;
    for (int i = 0; i <= kKeys; ++i) {
        const double angle = kTwoPi * i / kKeys;
        const glm::dvec3 from(std::sin(angle), 0.35, std::cos(angle));
        path.keyframes.push_back(keyframeAt(kDuration * i / kKeys, center + radius * from, center));
    }
    return path;
}

/// Returns a camera path over the model from corner to corner that looks ahead and down.
CameraPath flyby(const Box& bounds) {
    const glm::dvec3 extent = bounds.extent();
    const double height = bounds.max.y + 0.15 * std::max(extent.x, extent.z);
    const glm::dvec3 from(bounds.min.x - 0.1 * extent.x, height, bounds.min.z - 0.1 * extent.z);
    const glm::dvec3 to(bounds.max.x - 0.2 * extent.x, height, bounds.max.z - 0.2 * extent.z);
    const glm::dvec3 ahead = 0.35 * (to - from) - glm::dvec3(0, height - bounds.center().y, 0);
    return {false, Interpolation::Linear, {keyframeAt(0, from, from + ahead), keyframeAt(kDuration, to, to + ahead)}};
}

/// Returns the distance from `origin` along `direction` to the triangle `t`, or infinity if the ray misses it (Moeller,
/// Trumbore 1997).
double hitDistance(const TriangleCorners& t, const glm::dvec3& origin, const glm::dvec3& direction) {
    constexpr double kMissed = std::numeric_limits<double>::infinity();
    const glm::dvec3 along = t[1] - t[0];
    const glm::dvec3 across = t[2] - t[0];
    const glm::dvec3 p = glm::cross(direction, across);
    const double determinant = glm::dot(along, p);
    if (determinant == 0) return kMissed;
    const glm::dvec3 from = origin - t[0];
    const double u = glm::dot(from, p) / determinant;
    const glm::dvec3 q = glm::cross(from, along);
    const double v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(across, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && distance >= 0) return distance;
    return kMissed;
}

/// Returns the distance from `start` along `direction` (unit length) to the model at full detail, or infinity if the
/// ray misses it.
double surfaceDistance(const hierarchy::ModelFile& model, const glm::dvec3& start, const glm::dvec3& direction) {
    const glm::dvec3 origin = start - model.summary().grid.origin;
    const auto meets = [&](double, const Sphere& sphere) {
        const glm::dvec3 towards = sphere.center - origin;
        const double along = std::max(glm::dot(towards, direction), 0.0);
        return glm::length(towards - along * direction) <= sphere.radius;
    };
    double surface = std::numeric_limits<double>::infinity();
    forEachTriangle(model, meets, [&](const TriangleCorners& corners) {
        surface = std::min(surface, hitDistance(corners, start, direction));
    });
    return surface;
}

/// Returns the vertex of the model's coarsest level of detail whose direction from `start` is nearest to `direction`.
/// Vertices of the coarsest level are also vertices at full detail.
glm::dvec3 coarseVertexTowards(
    const hierarchy::ModelFile& model, const glm::dvec3& start, const glm::dvec3& direction) {
    glm::dvec3 nearest(0);
    double best = -2; // a cosine
    forEachTriangle(
        model,
        [](double, const Sphere&) { return false; },
        [&](const TriangleCorners& corners) {
            for (const glm::dvec3& corner : corners) {
                const double cosine = glm::dot(glm::normalize(corner - start), direction);
                if (cosine > best) {
                    best = cosine;
                    nearest = corner;
                }
            }
        });
    return nearest;
}

/// Returns a camera path from far away to very near the surface, with distances in a geometric sequence. The target is
/// the surface point in front of the middle of the model. If there is none, the target is the vertex of the coarsest
/// level nearest to that line of sight.
CameraPath approach(const hierarchy::ModelFile& model) {
    const Box bounds = hierarchy::mainPartOf(model.summary());
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(model.summary().up.direction);
    const glm::dvec3 from = glm::normalize(frame.toWorld({0.35, 0.25, 1}));
    const glm::dvec3 start = bounds.center() + 2.5 * glm::length(bounds.extent()) * from;
    glm::dvec3 direction = -from;
    double surface = surfaceDistance(model, start, direction);
    if (surface == std::numeric_limits<double>::infinity()) {
        const glm::dvec3 way = coarseVertexTowards(model, start, direction) - start;
        direction = glm::normalize(way);
        surface = std::min(glm::length(way), surfaceDistance(model, start, direction));
    }
    const glm::dvec3 target = start + surface * direction;
    constexpr double kNearest = 1e-3; // of the initial distance
    constexpr int kKeys = 24;
    CameraPath path;
    for (int i = 0; i <= kKeys; ++i) {
        const double distance = surface * std::pow(kNearest, static_cast<double>(i) / kKeys);
        path.keyframes.push_back(keyframeAt(kDuration * i / kKeys, target - distance * direction, target));
        path.keyframes.back().camera.up = frame.up;
    }
    return path;
}

/// Transforms a camera path from upright space, in which y is up, to world space.
CameraPath inWorld(CameraPath path, const hierarchy::UprightFrame& frame) {
    for (Keyframe& key : path.keyframes) {
        key.camera.eye = frame.toWorld(key.camera.eye);
        key.camera.target = frame.toWorld(key.camera.target);
        key.camera.up = frame.toWorld(key.camera.up);
    }
    return path;
}

} // namespace

CameraPath pathThrough(const std::vector<Camera>& cameras) {
    CameraPath path;
    for (const Camera& camera : cameras)
        path.keyframes.push_back({static_cast<double>(path.keyframes.size()), camera});
    return path;
}

CameraPath suitedPath(const hierarchy::ModelFile& model, const std::string& kind, const WalkOptions& walkOptions) {
    if (kind == "approach") return approach(model);
    const hierarchy::UprightFrame frame = hierarchy::uprightFrame(model.summary().up.direction);
    if (kind == "orbit") return inWorld(orbit(uprightBounds(model)), frame);
    if (kind == "flyby") return inWorld(flyby(uprightBounds(model)), frame);
    return inWorld(walk(model, walkOptions), frame);
}

} // namespace gnomon::path
