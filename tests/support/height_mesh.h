// A simplifier for height fields with locked borders, used for the tiny model.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace gnomon::tests {

using HeightTriangle = std::array<std::uint32_t, 3>; // vertex indices, counter-clockwise seen from above (+y)

/// Collapses unlocked vertices onto neighbours, smallest change of height first, until at most `target` triangles
/// remain or no collapse is possible. Vertices never move, and triangles never flip.
std::vector<HeightTriangle> decimated(
    std::span<const HeightTriangle> triangles,
    std::span<const glm::dvec3> positions,
    const std::function<bool(std::uint32_t)>& isLocked,
    std::size_t target);

/// Returns the max vertical distance between two height fields over the same area, where the vertices of `coarse` are a
/// subset of those of `fine`. It is exact, because it evaluates all vertices and all crossings of edges.
double verticalDeviation(
    std::span<const HeightTriangle> fine,
    std::span<const HeightTriangle> coarse,
    std::span<const glm::dvec3> positions);

} // namespace gnomon::tests
