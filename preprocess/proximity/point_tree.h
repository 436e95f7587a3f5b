// A kd-tree of points in components, for the nearest one of another component.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::proximity {

/// Boxes are halved across their widest side down to a few points; Bentley, "Multidimensional binary search trees",
/// 1975, with the planes in the middle of the space instead of the points, which is quicker to build.
class PointTree {
public:
    /// Of `points`, finite, each in the component of that place in `components`.
    PointTree(std::span<const glm::dvec3> points, std::span<const std::uint32_t> components);

    /// The index of the point nearest to `place` that is not in `component`, the least of those equally near; kNone if
    /// all are.
    std::uint32_t nearest(const glm::dvec3& place, std::uint32_t component) const;

private:
    using Place = std::array<double, 3>;

    struct Point {
        Place place;
        std::uint32_t index;
        std::uint32_t component;
    };

    struct Node {
        std::uint32_t begin = 0; // of its points
        std::uint32_t end = 0;
        double plane = 0;
        std::uint32_t axis = 0;
        std::uint32_t right = 0; // the child of what is not below the plane, the other follows its parent; 0 for a leaf
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
