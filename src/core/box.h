// Axis-aligned boxes and spheres in double precision.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <limits>

namespace gnomon {

/// A closed axis-aligned box. A default-constructed box is empty (min is greater than max) until a point or a box is
/// added.
struct Box {
    glm::dvec3 min{std::numeric_limits<double>::infinity()};
    glm::dvec3 max{-std::numeric_limits<double>::infinity()};

    bool isEmpty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }

    void add(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }

    void add(const Box& box) {
        min = glm::min(min, box.min);
        max = glm::max(max, box.max);
    }

    glm::dvec3 center() const { return (min + max) * 0.5; }

    glm::dvec3 extent() const { return isEmpty() ? glm::dvec3(0) : max - min; }
};

/// A ball: all points whose distance from `center` is at most `radius`.
struct Sphere {
    glm::dvec3 center{0};
    double radius = 0;
};

/// Returns the distance between `point` and `box`, or 0 if the point is inside.
inline double distance(const Box& box, const glm::dvec3& point) {
    return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::dvec3(0)));
}

/// Returns the distance between `point` and `sphere`, or 0 if the point is inside.
inline double distance(const Sphere& sphere, const glm::dvec3& point) {
    return std::max(0.0, glm::length(point - sphere.center) - sphere.radius);
}

} // namespace gnomon
