// A kd-tree of points, each of which belongs to a component of a mesh. The tree finds the nearest point of another
// component.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::proximity {

/// A kd-tree whose leaves have at most 12 points (Bentley, "Multidimensional binary search trees", 1975). Each box is
/// split at the centre of its longest side. Bentley splits at the median point, but a split at the centre is faster to
/// build.
class PointTree {
public:
    /// Builds the tree over `points`, whose coordinates must be finite. Point i belongs to the component
    /// `components[i]`.
    PointTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> components);

    /// Returns the index of the point nearest to `place` that does not belong to `component`. Among points at equal
    /// distance it returns the smallest index. Returns kNone if all points belong to `component`.
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
        // Index of the child on or above the splitting plane; 0 for a leaf. The child below the plane follows its
        // parent.
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
