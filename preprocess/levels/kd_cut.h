// One cut through weighted points: where along an axis it lies, and the points parted there.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace gnomon::levels {

/// What is moved about in the place of an item.
struct alignas(16) KdPoint {
    glm::vec3 center;
    std::uint32_t item; // its place among the items; breaks ties
};

/// Between which centers lie.
struct KdBounds {
    glm::vec3 low;
    glm::vec3 high;
};

KdBounds boundsOf(std::span<const KdPoint> points);

/// The axis along which they are widest; of several the first.
int widestAxis(const KdBounds& bounds);

/// The low side of a cut: how many points it has and what they compareCandidates.
struct KdSide {
    std::size_t count;
    std::uint64_t weight;
};

/// Parts `points`, at least two, which come in the order of their items, across the axis along which they are spread
/// widest: those that come first by center and item go to the front, and both sides are in the order of their items
/// again. The low side weighs at most `target`, as near to it as the points allow, but neither side is empty. `weights`
/// are those of all items, each at least 1; those of the points are more than `target` together. `spare` is as long as
/// `points`, and what it holds afterwards means nothing.
KdSide cutPoints(
    std::span<KdPoint> points, std::span<KdPoint> spare, std::span<const std::uint32_t> weights, std::uint64_t target);

} // namespace gnomon::levels
