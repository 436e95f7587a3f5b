// Projects samples (visible points) onto the plane of a grid map and finds their grid cells, with one sample per SIMD
// lane.
#pragma once

#include "exact/sample_list.h"

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <span>

namespace gnomon::exact {

/// The bounds of the samples of one map, after their projection to the plane of the map.
struct Extent {
    std::size_t samples = 0;
    double minW = std::numeric_limits<double>::infinity();
    double maxW = -std::numeric_limits<double>::infinity();
    glm::dvec2 min{std::numeric_limits<double>::infinity()};
    glm::dvec2 max{-std::numeric_limits<double>::infinity()};

    void add(const Extent& other);
};

/// The samples [begin, end) of a sample list.
struct SampleRun {
    const SampleList* samples = nullptr;
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// Returns the bounds of the projected samples of `run` that belong to `map`. The position of sample (u, v, h) is (x /
/// w, y / w) with (x, y, w) = plane * (u, v, h, 1). NaN is ignored. The result does not depend on the instruction set.
Extent extentOn(const glm::dmat4x3& plane, std::size_t map, const SampleRun& run);

/// Computes the cell of each sample of `run` that belongs to `map`. The index of a cell is y * side + x, with (x, y, 1)
/// w = matrix * (u, v, h, 1), and x and y are clamped to [0, side). `cells` has one entry per sample of `run`. Entries
/// of samples of other maps do not change. The result does not depend on the instruction set.
void findCells(
    const glm::dmat4x3& matrix, std::size_t map, int side, const SampleRun& run, std::span<std::uint32_t> cells);

/// Returns the index of the cell column or row that contains coordinate `x`, clamped to [0, side - 1].
inline int cellAt(double x, int side) {
    return x >= side ? side - 1 : x > 0 ? static_cast<int>(x) : 0;
}

} // namespace gnomon::exact
