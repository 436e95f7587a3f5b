// A bounding volume hierarchy over indexed triangles. It finds the triangle that is nearest to a point, without
// approximation.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace gnomon::verify {

/// A set of triangles with shared positions. Positions are in local space (near the origin), which preserves double
/// precision.
struct TriangleSoup {
    std::vector<glm::dvec3> positions;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    const glm::dvec3& corner(std::uint32_t triangle, std::size_t k) const { return positions[triangles[triangle][k]]; }

    double area(std::uint32_t triangle) const {
        const glm::dvec3& a = corner(triangle, 0);
        return 0.5 * glm::length(glm::cross(corner(triangle, 1) - a, corner(triangle, 2) - a));
    }

    /// Returns the point of triangle `triangle` with the barycentric coordinates 1 - u - v, u, v.
    glm::dvec3 point(std::uint32_t triangle, double u, double v) const {
        return corner(triangle, 0) * (1 - u - v) + corner(triangle, 1) * u + corner(triangle, 2) * v;
    }
};

/// Returns the squared distance from `p` to the triangle a, b, c, which may be degenerate (Ericson, "Real-Time
/// Collision Detection", 2005, section 5.1.5).
double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

/// A bounding volume hierarchy over the triangles of a TriangleSoup, which must outlive this object.
class TriangleTree {
public:
    explicit TriangleTree(const TriangleSoup& soup);

    struct Nearest {
        double distance = std::numeric_limits<double>::infinity();
        std::uint32_t triangle = 0xFFFFFFFFU;
    };

    /// Returns the triangle nearest to `point` and its distance. `hint` can be a triangle that is probably near. It
    /// makes the search faster but does not change the distance. The distance is infinite if there are no triangles.
    Nearest nearest(const glm::dvec3& point, std::uint32_t hint = 0xFFFFFFFFU) const;

private:
    struct Bounds {
        std::array<float, 3> min{}; // rounded outwards to floats
        std::array<float, 3> max{};

        double squaredDistance(const glm::dvec3& point) const;
    };

    struct Node {
        Bounds bounds;
        // For a leaf: the first of its triangles in order_. For an inner node: the index of its right child. The left
        // child directly follows its parent.
        std::uint32_t next = 0;
        std::uint32_t count = 0; // number of triangles of a leaf; 0 for an inner node
    };

    struct Item;

    Bounds build(std::vector<Item>& items, std::uint32_t index, std::uint32_t begin, std::uint32_t end);
    Bounds buildLeaf(const std::vector<Item>& items, Node& node, std::uint32_t begin, std::uint32_t end);

    const TriangleSoup& soup_;
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
};

} // namespace gnomon::verify
