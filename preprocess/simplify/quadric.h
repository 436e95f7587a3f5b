// The quadric error metric: a weighted sum of squared distances to a set of planes.
#pragma once

#include <glm/glm.hpp>

#include <algorithm>

namespace gnomon::simplify {

/// A weighted sum of squared distances from a point to planes, as a quadratic form of the point (Garland, Heckbert,
/// "Surface Simplification Using Quadric Error Metrics", 1997).
struct Quadric {
    glm::dvec3 diagonal{0}; // coefficients of xx, yy, zz
    glm::dvec3 mixed{0};    // coefficients of xy, yz, zx
    glm::dvec3 linear{0};
    double constant = 0;
    double weight = 0;

    /// Adds the plane through `point` with the unit vector `normal` and the weight `planeWeight`.
    void addPlane(const glm::dvec3& normal, const glm::dvec3& point, double planeWeight) {
        const double d = -glm::dot(normal, point);
        diagonal += normal * normal * planeWeight;
        mixed += glm::dvec3(normal.x * normal.y, normal.y * normal.z, normal.z * normal.x) * planeWeight;
        linear += normal * (d * planeWeight);
        constant += d * d * planeWeight;
        weight += planeWeight;
    }

    void add(const Quadric& other) {
        diagonal += other.diagonal;
        mixed += other.mixed;
        linear += other.linear;
        constant += other.constant;
        weight += other.weight;
    }

    /// Returns the weighted mean of the squared distances of `p` from the planes, or 0 without planes.
    double meanSquare(const glm::dvec3& p) const {
        if (!(weight > 0)) return 0;
        const double square =
            glm::dot(diagonal, p * p) + 2 * (mixed.x * p.x * p.y + mixed.y * p.y * p.z + mixed.z * p.z * p.x);
        return std::max(0.0, square + 2 * glm::dot(linear, p) + constant) / weight;
    }
};

} // namespace gnomon::simplify
