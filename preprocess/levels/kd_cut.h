// Divides weighted points by one plane perpendicular to the widest axis of their bounds.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace gnomon::levels {

/// The centre and the index of an item that is sorted by a kd-tree. The sort moves these compact copies instead of the
/// items.
struct alignas(16) KdPoint {
    glm::vec3 center;
    std::uint32_t item; // index of the item; breaks ties
};

/// The bounding box of the centres of several points.
struct KdBounds {
    glm::vec3 low;
    glm::vec3 high;
};

/// Returns the bounding box of the centres of `points`.
KdBounds boundsOf(std::span<const KdPoint> points);

/// Returns the axis of the largest extent. Among equal extents it returns the first axis.
int widestAxis(const KdBounds& bounds);

/// The number and the total weight of the points on the low side of a dividing plane.
struct KdSide {
    std::size_t count;
    std::uint64_t weight;
};

/// Divides `points` into two sides by a plane across their widest axis, like a kd-tree. The points on the low side move
/// to the front. They are the first points in the order of centre and then item. Each side remains sorted by item.
/// `points` contains at least two points, sorted by item. The weight of the low side is at most `target` and as close
/// to it as the points permit, but each side has at least one point. `weights` contains the weight of each item, at
/// least 1. The total weight of the points must exceed `target`. `spare` is a buffer of the same size as `points`.
KdSide cutPoints(
    std::span<KdPoint> points, std::span<KdPoint> spare, std::span<const std::uint32_t> weights, std::uint64_t target);

} // namespace gnomon::levels
