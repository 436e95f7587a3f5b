// A bounding volume hierarchy over boxes with errors. Embree builds the hierarchy once, with eight children per node.
// traversal.h contains the traversal.
#pragma once

#include "core/box.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::lod {

/// An item of the bounding volume hierarchy. Volumes are tested against `box`, and an error rule against `bounds` and
/// `error`.
struct Item {
    Box box;
    Sphere bounds;
    double error = 0; // may be infinite
};

constexpr std::size_t kWidth = 8;

/// A node of the hierarchy with eight children in structure-of-arrays layout. Floats are rounded outwards: a child that
/// fails a test with these values also fails with its exact values.
struct Node {
    std::array<std::array<float, kWidth>, 3> min{};
    std::array<std::array<float, kWidth>, 3> max{};
    std::array<std::array<float, kWidth>, 4> bounds{}; // sphere: x, y, z, radius
    std::array<float, kWidth> error{};
    std::array<std::uint32_t, kWidth> child{}; // index of a node, or of an item if the child's bit in `leaves` is set
    std::uint8_t count = 0;
    std::uint8_t leaves = 0;
};

/// The bounding volume hierarchy. An item is identified by its index in the array from which the hierarchy was built.
class Tree {
public:
    Tree() = default;

    /// Builds the hierarchy over `items` with a surface area heuristic (rtcBuildBVH of Embree 3). The build uses one
    /// thread, so equal items give equal hierarchies. Throws Error if Embree fails.
    explicit Tree(std::span<const Item> items);

    bool isEmpty() const { return nodes_.empty(); }

    /// Returns the nodes of the hierarchy. The root is node 0; children follow their parents.
    std::span<const Node> nodes() const { return nodes_; }

    /// Returns the indices of the items in the order of the leaves. Adjacent items are near each other in space.
    std::span<const std::uint32_t> order() const { return order_; }

    /// Returns the largest absolute coordinate of all boxes. The rounding margin of the traversal is proportional to
    /// it.
    double reach() const { return reach_; }

private:
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    double reach_ = 0;
};

} // namespace gnomon::lod
