// A triangle mesh prepared for distance queries. It stores the neighbours across edges and a tree that finds the
// nearest triangle.
#pragma once

#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/triangle_adjacency.h"

#include <glm/glm.hpp>

#include <span>

namespace gnomon::simplify {

/// A triangle mesh for distance queries. The array of positions must outlive it.
class Surface {
public:
    Surface(std::span<const glm::dvec3> positions, std::vector<Triangle> triangles);

    const std::vector<Triangle>& triangles() const { return triangles_; }

    const glm::dvec3& corner(std::uint32_t triangle, std::size_t i) const {
        return positions_[triangles_[triangle][i]];
    }

    proximity::PreparedTriangle prepared(std::uint32_t triangle) const {
        return {corner(triangle, 0), corner(triangle, 1), corner(triangle, 2)};
    }

    double squaredDistance(const glm::dvec3& p, std::uint32_t triangle) const {
        return proximity::squaredDistance(p, corner(triangle, 0), corner(triangle, 1), corner(triangle, 2));
    }

    /// Returns a triangle that shares edge `i` with `triangle`, or kNone. Edge i goes from corner i to the next corner.
    std::uint32_t across(std::uint32_t triangle, std::uint32_t i) const { return across_[triangle][i]; }

    /// Returns the triangles that have a corner at `position`.
    std::span<const std::uint32_t> around(std::uint32_t position) const { return adjacency_.around(position); }

    /// Returns the triangle nearest to the point `p`. The first call builds a search tree.
    std::uint32_t nearest(const glm::dvec3& p);

private:
    struct Leaf {
        glm::vec3 center; // three times the centroid of the triangle
        std::uint32_t triangle = 0;
    };

    struct Node {
        glm::dvec3 low;
        glm::dvec3 high;
        std::uint32_t begin; // index of the node's first triangle in leaves_
        std::uint32_t end;
        std::uint32_t right; // index of the second child; the first child follows its parent; 0 for a leaf
    };

    void buildTree(std::uint32_t begin, std::uint32_t end);

    std::span<const glm::dvec3> positions_;
    std::vector<Triangle> triangles_;
    TriangleAdjacency adjacency_;
    std::vector<Triangle> across_;
    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_; // the triangles in tree order
};

} // namespace gnomon::simplify
