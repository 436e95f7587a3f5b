// A kd-tree of points that belong to components. It finds the nearest point of another component.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::proximity {

/// A kd-tree that splits each box at the centre of its longest side until a leaf has at most 12 points (Bentley,
/// "Multidimensional binary search trees", 1975). Bentley splits at the median point. A split at the centre is faster
/// to build.
class PointTree {
public:
    /// Builds the tree over finite `points`, where point i belongs to component `components[i]`.
    PointTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> components);

    /// Returns the index of the point nearest to `place` that is outside `component`. Among points at equal distance it
    /// returns the smallest index. Returns kNone if all points are in `component`.
    std::uint32_t nearest(const glm::dvec3& place, std::uint32_t component) const;

private:
    using Place = std::array<double, 3>;

    struct Point {
        Place place;
        std::uint32_t index;
        std::uint32_t component;
    };

    struct Node {
        std::uint32_t begin = 0; // index of the first point
        std::uint32_t end = 0;
        double plane = 0;
        std::uint32_t axis = 0;
        // Index of the child on or above the plane; the child below it follows its parent; 0 for a leaf.
        std::uint32_t right = 0;
    };

    struct Query {
        Place place;
        std::uint32_t component;
        double bestSquare;
        std::uint32_t best;
    };

    void build(std::uint32_t begin, std::uint32_t end);
    void visit(std::uint32_t index, Query& query) const;

    std::vector<Point> points_;
    std::vector<Node> nodes_;
};

} // namespace gnomon::proximity
