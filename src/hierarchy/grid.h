// The integer grid of all vertex positions of a model. All clusters use the same grid, so positions on their shared
// borders are bit-identical.
#pragma once

#include "core/box.h"

#include <cmath>
#include <compare>
#include <cstdint>

namespace gnomon::hierarchy {

/// The max coordinate of a grid point. It is below 2^31, so that the difference of two coordinates fits in an int32.
/// The shaders subtract the grid point of the eye before they convert to floats.
constexpr std::uint32_t kMaxGridCoordinate = 0x7FFFFFFFU;

/// Limits of the exponent of the grid step and of world coordinates. Within them, squared distances in double precision
/// neither overflow nor become denormal.
constexpr int kMinStepExponent = -600;
constexpr int kMaxStepExponent = 320;
constexpr double kMaxCoordinate = 0x1p340;

/// A point of the vertex grid, given by its integer coordinates.
struct GridPoint {
    std::uint32_t x = 0;
    std::uint32_t y = 0;
    std::uint32_t z = 0;
    auto operator<=>(const GridPoint&) const = default;
};

/// A closed axis-aligned box of grid points.
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

/// The mapping from grid points to world positions: world = origin + step * grid point. LOCAL space is world space
/// minus `origin`, in world units. Spheres, boxes and errors of a model are stored in local space. All code at run time
/// uses local space or eye-relative space.
struct Grid {
    glm::dvec3 origin{0};
    int stepExponent = 0; // step = 2^stepExponent, exact in each floating-point format

    double step() const { return std::ldexp(1.0, stepExponent); }

    glm::dvec3 local(const GridPoint& p) const { return glm::dvec3(p.x, p.y, p.z) * step(); }

    glm::dvec3 world(const GridPoint& p) const { return origin + local(p); }

    Box local(const GridBox& box) const { return {local(box.min), local(box.max)}; }

    /// Returns the max rounding error of a position, in world units: half the diagonal of a grid cell.
    double snapError() const { return 0.5 * std::sqrt(3.0) * step(); }
};

} // namespace gnomon::hierarchy
