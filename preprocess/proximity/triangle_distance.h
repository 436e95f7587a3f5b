// Computes the distance from a point to a triangle, and the feature of the triangle that is nearest to the point.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>

namespace gnomon::proximity {

/// Returns the squared length of `v`.
inline double squaredLength(const glm::dvec3& v) {
    return glm::dot(v, v);
}

/// The feature of a triangle (the face, an edge or a corner) that contains the triangle's nearest point to a query
/// point.
enum class TriangleFeature : std::uint8_t {
    Face,
    Edge0,
    Edge1,
    Edge2,
    Corner0,
    Corner1,
    Corner2
}; // edge i goes from corner i to corner (i + 1) % 3

/// The squared distance from a point to a triangle, and the nearest feature of the triangle.
struct TriangleDistance {
    double square = 0; // squared distance
    TriangleFeature feature = TriangleFeature::Face;
};

/// A triangle with precomputed edges and normals, for fast distance queries from many points. The triangle may be
/// degenerate.
class PreparedTriangle {
public:
    PreparedTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

    TriangleDistance distanceTo(const glm::dvec3& p) const;

private:
    /// Returns the squared distance from `p` to the edge from corner `i` to the next corner.
    TriangleDistance distanceToEdge(const glm::dvec3& p, std::uint32_t i) const;

    std::array<glm::dvec3, 3> corners_;
    std::array<glm::dvec3, 3> edges_; // from each corner to the next corner
    // Per edge: its normal in the plane of the triangle, towards the inside; 0 for a degenerate triangle.
    std::array<glm::dvec3, 3> inwards_;
    glm::dvec3 normal_;
    double area_ = 0; // square of twice the triangle's area
};

/// Returns the squared distance from `p` to the triangle `a`, `b`, `c`, and the nearest feature. The triangle may be
/// degenerate.
TriangleDistance distanceToTriangle(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Returns the squared distance from `p` to a computed point of the triangle `a`, `b`, `c` (Ericson, "Real-Time
/// Collision Detection", 2005, section 5.1.5). The result is an upper bound of the exact squared distance. It differs
/// from the exact value only by rounding. For a triangle without area the result may be the distance to only one of its
/// edges.
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// Returns an upper bound of the squared distance from `p` to the segment from `a` to `b`. The bound differs from the
/// exact value only by rounding.
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b);

} // namespace gnomon::proximity
