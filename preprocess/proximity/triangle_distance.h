// The distance from a point to a triangle, and which part of the triangle is nearest.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon::proximity {

inline double squaredLength(const glm::dvec3& v) {
    return glm::dot(v, v);
}

/// The feature of a triangle on which its point nearest to another one lies.
enum class TriangleFeature : std::uint8_t {
    Face,
    Edge0,
    Edge1,
    Edge2,
    Corner0,
    Corner1,
    Corner2
}; // edge i: i to i + 1

struct TriangleDistance {
    double square = 0; // of the distance
    TriangleFeature feature = TriangleFeature::Face;
};

/// A triangle, which may be degenerate, for the distances of many points.
class PreparedTriangle {
public:
    PreparedTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

    TriangleDistance distanceTo(const glm::dvec3& p) const;

private:
    /// From the edge from corner `i` to the next.
    TriangleDistance distanceToEdge(const glm::dvec3& p, std::uint32_t i) const;

    std::array<glm::dvec3, 3> corners_;
    std::array<glm::dvec3, 3> edges_;   // from each corner to the next
    std::array<glm::dvec3, 3> inwards_; // of each edge, at right angles to it, in the plane; 0 if there is none
    glm::dvec3 normal_;
    double area_ = 0; // the square of twice that
};

/// The squared distance of `p` from the triangle `a`, `b`, `c`, which may be degenerate.
TriangleDistance distanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// An upper bound of the squared distance of `p` from the triangle that is its exact value but for rounding: the
/// distance from a point of the triangle that is computed explicitly. Ericson, "Real-Time Collision Detection", 2005,
/// 5.1.5. Of a triangle without area perhaps that of one of its edges alone.
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// The same for the segment from `a` to `b`.
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b);

} // namespace gnomon::proximity
