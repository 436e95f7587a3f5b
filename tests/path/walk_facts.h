// Properties of a walk through a model, computed by brute force over all finest triangles.
#pragma once

#include "path/camera_path.h"
#include "path/walkable_floor.h"
#include "tests/path/made_model.h"

#include <limits>

namespace gnomon::path {

struct WalkFacts {
    double length = 0;
    double clearance = 0; // min distance of the eye from the model, at most half the eye height
    int strayed = 0;      // number of samples without a floor below
    double lowest = std::numeric_limits<double>::infinity(); // of the eye
    double highest = -std::numeric_limits<double>::infinity();
};

/// Returns true if the ray down from `eye` first hits a surface at eye height, with a tolerance of one step. If `reach`
/// is greater than 0, returns true if a surface is within `reach` of the foot, because on a grating the ray can pass
/// between two bars.
inline bool isOnFloor(
    const std::vector<std::array<glm::dvec3, 3>>& triangles,
    const glm::dvec3& eye,
    const WalkBody& body,
    double reach) {
    const glm::dvec3 foot = eye - glm::dvec3(0, body.eyeHeight, 0);
    double first = std::numeric_limits<double>::infinity();
    for (const auto& t : triangles) {
        const glm::dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]) - reach;
        const glm::dvec3 high = glm::max(glm::max(t[0], t[1]), t[2]) + reach;
        if (eye.x < low.x || eye.x > high.x || eye.z < low.z || eye.z > high.z || low.y > eye.y) continue;
        if (reach > 0) {
            if (proximity::distanceToTriangle(foot, t[0], t[1], t[2]).square <= reach * reach) return true;
            continue;
        }
        const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
        if (normal.y == 0) continue;
        const double down = glm::dot(eye - t[0], normal) / normal.y;
        const glm::dvec3 at = eye - glm::dvec3(0, down, 0);
        if (down >= 0 && proximity::distanceToTriangle(at, t[0], t[1], t[2]).square < 1e-12)
            first = std::min(first, down);
    }
    return std::abs(first - body.eyeHeight) <= body.step;
}

/// Returns the triangles whose boxes are within `away` of `bounds`.
inline std::vector<std::array<glm::dvec3, 3>> trianglesNear(
    const std::vector<std::array<glm::dvec3, 3>>& triangles, const Box& bounds, double away) {
    const Box box{bounds.min - away, bounds.max + away};
    std::vector<std::array<glm::dvec3, 3>> near;
    for (const auto& t : triangles) {
        const glm::dvec3 low = glm::min(glm::min(t[0], t[1]), t[2]);
        const glm::dvec3 high = glm::max(glm::max(t[0], t[1]), t[2]);
        if (glm::all(glm::lessThanEqual(low, box.max)) && glm::all(glm::greaterThanEqual(high, box.min)))
            near.push_back(t);
    }
    return near;
}

/// Computes the properties from samples every 5 cm, for a body of 1.7 m. If the clearance at each sample exceeds this
/// distance, the walk passes through no surface between samples.
inline WalkFacts factsOf(const MadeModel& model, const CameraPath& path, const WalkBody& body, double reach = 0) {
    WalkFacts facts;
    facts.clearance = 0.5 * body.eyeHeight;
    Box bounds;
    for (const Keyframe& key : path.keyframes)
        bounds.add(key.camera.eye);
    const auto aroundAll = trianglesNear(model.triangles(), bounds, 2 * body.eyeHeight);
    for (std::size_t i = 0; i + 1 < path.keyframes.size(); ++i) {
        const glm::dvec3 a = path.keyframes[i].camera.eye;
        const glm::dvec3 b = path.keyframes[i + 1].camera.eye;
        facts.length += glm::distance(a, b);
        const auto near = trianglesNear(aroundAll, {glm::min(a, b), glm::max(a, b)}, 2 * body.eyeHeight);
        const int samples = std::max(1, static_cast<int>(std::ceil(glm::distance(a, b) / (0.03 * body.eyeHeight))));
        for (int sample = 0; sample < samples; ++sample) {
            const glm::dvec3 eye = glm::mix(a, b, static_cast<double>(sample) / samples);
            facts.clearance = clearanceOf(near, eye, facts.clearance);
            facts.strayed += isOnFloor(near, eye, body, reach) ? 0 : 1;
            facts.lowest = std::min(facts.lowest, eye.y);
            facts.highest = std::max(facts.highest, eye.y);
        }
    }
    return facts;
}

} // namespace gnomon::path
