// Where samples lie on the planes of cell maps, several at once.
#pragma once

#include "exact/sample_list.h"

#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <limits>
#include <span>

namespace gnomon::exact {

/// What the samples of a map span on its plane.
struct Extent {
    std::size_t samples = 0;
    double leastW = std::numeric_limits<double>::infinity();
    double mostW = -std::numeric_limits<double>::infinity();
    glm::dvec2 least{std::numeric_limits<double>::infinity()};
    glm::dvec2 most{-std::numeric_limits<double>::infinity()};

    void add(const Extent& other);
};

/// A run of samples in a list.
struct SampleRun {
    const SampleList* samples = nullptr;
    std::size_t begin = 0;
    std::size_t end = 0;
};

/// What those samples of `run` span that belong to `map`, on a plane x/w, y/w of (x, y, w) = plane * (u, v, h, 1). What
/// is no number there counts for nothing. The result does not depend on the instruction set.
Extent extentOn(const glm::dmat4x3& plane, std::size_t map, const SampleRun& run);

/// The cell of each sample of `run`, y * side + x where (x, y) w = matrix * (u, v, h, 1), held to [0, side): by place
/// in the run, of those that belong to `map`. The others are left alone. The result does not depend on the instruction
/// set.
void findCells(
    const glm::dmat4x3& matrix, std::size_t map, int side, const SampleRun& run, std::span<std::uint32_t> cells);

/// The cell coordinate `x` falls into, in [0, side).
inline int cellAt(double x, int side) {
    return x >= side ? side - 1 : x > 0 ? static_cast<int>(x) : 0;
}

} // namespace gnomon::exact
