// The one global grid on which every position of a model lies, so that shared borders agree to the bit.
#pragma once

#include "core/box.h"

#include <cmath>
#include <compare>
#include <cstdint>

namespace gnomon::hierarchy {

/// Grid coordinates stay below 2^31, so that differences of two fit an int32 (the shaders subtract the eye's cell
/// first).
constexpr std::uint32_t kMaxGridCoordinate = 0x7FFFFFFFU;

/// The exponents that a grid's step may have, and how far from 0 its points may lie in the world: squares of distances
/// are doubles then, neither infinite nor denormal.
constexpr int kLeastStepExponent = -600;
constexpr int kMostStepExponent = 320;
constexpr double kMostCoordinate = 0x1p340;

/// A point of the grid.
struct GridPoint {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t z = 0;
    auto operator<=>(const GridPoint&) const = default;
};

/// A closed box of grid points.
struct GridBox {
    GridPoint min{kMaxGridCoordinate, kMaxGridCoordinate, kMaxGridCoordinate};
    GridPoint max{0, 0, 0};

    void add(const GridPoint& p) {
        min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
        max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
    }

    void add(const GridBox& box) {
        add(box.min);
        add(box.max);
    }
};

/// World position = origin + step * grid point. LOCAL space is world space minus `origin`, in world units: spheres,
/// boxes and errors of a model are stored in it, and everything at run time works in it or relative to the eye.
struct Grid {
    glm::dvec3 origin{0};
    int stepExponent = 0; // step = 2^stepExponent, exact in every float format

    double step() const { return std::ldexp(1.0, stepExponent); }

    glm::dvec3 local(const GridPoint& p) const { return glm::dvec3(p.x, p.y, p.z) * step(); }

    glm::dvec3 world(const GridPoint& p) const { return origin + local(p); }

    Box local(const GridBox& box) const { return {local(box.min), local(box.max)}; }

    /// How far a source position may have moved when it was snapped: half a cell's diagonal.
    double snapError() const { return 0.5 * std::sqrt(3.0) * step(); }
};

} // namespace gnomon::hierarchy
