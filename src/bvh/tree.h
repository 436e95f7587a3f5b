// A bounding volume tree over boxes with errors: eight children a node, built once by Embree, walked by our own code.
#pragma once

#include "core/box.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::bvh {

/// What the tree is made over: `box` is tested against volumes, `bounds` and `error` against an error rule.
struct Item {
    Box box;
    Sphere bounds;
    double error = 0; // may be infinite
};

constexpr std::size_t kWidth = 8;

/// Eight children side by side. Floats, rounded outwards, so that a test that fails here fails for the child itself.
struct Node {
    std::array<std::array<float, kWidth>, 3> min{};
    std::array<std::array<float, kWidth>, 3> max{};
    std::array<std::array<float, kWidth>, 4> bounds{}; // sphere: x, y, z, radius
    std::array<float, kWidth> error{};
    std::array<std::uint32_t, kWidth> child{}; // a node, or an item where the lane's bit in `leaves` is set
    std::uint8_t count = 0;
    std::uint8_t leaves = 0;
};

/// The tree. Items are named by their index in the span that it was built from.
class Tree {
public:
    Tree() = default;

    /// Builds over `items` with a surface area heuristic (rtcBuildBVH of Embree 3, one thread, so that the same items
    /// give the same tree). Throws Error if Embree refuses.
    explicit Tree(std::span<const Item> items);

    bool isEmpty() const { return nodes_.empty(); }

    /// The root is node 0; children follow their parents.
    std::span<const Node> nodes() const { return nodes_; }

    /// The items as the tree's leaves lie from left to right: neighbours in it are neighbours in space.
    std::span<const std::uint32_t> order() const { return order_; }

    /// The largest absolute coordinate of any box: scales the rounding margin of the traversal.
    double reach() const { return reach_; }

private:
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    double reach_ = 0;
};

} // namespace gnomon::bvh
