// Divides weighted points into two sides by one plane across their widest axis.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace gnomon::levels {

/// A compact copy of an item: its centre and its index. The cut moves these copies instead of the items.
struct alignas(16) KdPoint {
    glm::vec3 center;
    std::uint32_t item; // index of the item; breaks ties
};

/// The bounding box of the centres of items.
struct KdBounds {
    glm::vec3 low;
    glm::vec3 high;
};

/// Returns the bounds of the centres of `points`.
KdBounds boundsOf(std::span<const KdPoint> points);

/// Returns the axis of the largest extent. Among equal extents it returns the first axis.
int widestAxis(const KdBounds& bounds);

/// The number and the total weight of the points on the low side of a cut.
struct KdSide {
    std::size_t count;
    std::uint64_t weight;
};

/// Partitions `points` across their widest axis. The points on the low side, in the order of centre and then item, move
/// to the front. Each side remains sorted by item. `points` contains at least two points, sorted by item. The weight of
/// the low side is at most `target` and as close to it as the points permit, but each side has at least one point.
/// `weights` contains the weight of each item, at least 1. The total weight of the points must exceed `target`. `spare`
/// is a buffer of the same size as `points`.
KdSide cutPoints(
    std::span<KdPoint> points, std::span<KdPoint> spare, std::span<const std::uint32_t> weights, std::uint64_t target);

} // namespace gnomon::levels
