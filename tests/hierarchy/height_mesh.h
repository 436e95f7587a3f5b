// A height field of triangles that loses vertices inside a locked border: the simplifier of the tiny model.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::tests {

using HeightTriangle = std::array<std::uint32_t, 3>; // indices of positions, counter-clockwise from above (+y)

/// Removes unlocked vertices, each by moving it onto a neighbour, the least change of height first, until at most
/// `target` triangles are left or none can go. Vertices never move; triangles never flip.
std::vector<HeightTriangle> decimated(
    std::span<const HeightTriangle> triangles,
    std::span<const glm::dvec3> positions,
    const std::function<bool(std::uint32_t)>& isLocked,
    std::size_t target);

/// The largest vertical distance between two height fields over the same ground, the vertices of `coarse` being some
/// of those of `fine`: taken at the vertices and at all crossings of edges, so it is exact.
double verticalDeviation(
    std::span<const HeightTriangle> fine,
    std::span<const HeightTriangle> coarse,
    std::span<const glm::dvec3> positions);

} // namespace gnomon::tests
