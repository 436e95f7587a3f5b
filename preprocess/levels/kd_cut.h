// One cut through weighted points across their widest axis.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <span>

namespace gnomon::levels {

/// A compact copy of an item that the cut moves: its centre and its index.
struct alignas(16) KdPoint {
    glm::vec3 center;
    std::uint32_t item; // index of the item; breaks ties
};

/// The bounds of centres.
struct KdBounds {
    glm::vec3 low;
    glm::vec3 high;
};

/// Returns the bounds of the centres of `points`.
KdBounds boundsOf(std::span<const KdPoint> points);

/// Returns the axis of the largest extent. Among equal extents it returns the first axis.
int widestAxis(const KdBounds& bounds);

/// The low side of a cut: the number of its points and their total weight.
struct KdSide {
    std::size_t count;
    std::uint64_t weight;
};

/// Partitions `points` across their widest axis: the points that are first by centre and item move to the front. Both
/// sides remain in the order of their items. `points` contains at least two points, sorted by item.
///
/// The low side weighs at most `target`, as close to it as the points permit, but both sides have at least one point.
/// `weights` contains the weight of each item, at least 1. The total weight of the points exceeds `target`. `spare` is
/// a buffer of the same size as `points`.
KdSide cutPoints(
    std::span<KdPoint> points, std::span<KdPoint> spare, std::span<const std::uint32_t> weights, std::uint64_t target);

} // namespace gnomon::levels
