// Finds the solid heights of a model in each column of a grid. This voxelization is the first step of navigation meshes
// (Recast, Mononen 2009).
#pragma once

#include "core/box.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::path {

/// A half-open range of heights that are solid, in height steps of the grid.
struct SolidSpan {
    std::int32_t bottom = 0;
    std::int32_t top = 0;
};

/// A grid of square columns over a region, with equal steps of height. Positions are in world units, and y is up.
struct ColumnGrid {
    glm::dvec3 origin{0}; // corner of column (0, 0), at height 0
    double cell = 0.1;    // side of a column
    double rise = 0.02;   // one step of height
    std::int32_t width = 0;
    std::int32_t depth = 0;

    /// Creates a grid that covers `region` with columns of side `side` and height steps of `step`.
    ColumnGrid(const Box& region, double side, double step);

    std::size_t columnCount() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(depth); }
};

/// The solid ranges of heights (spans) in all columns of a grid. Two spans of a column are merged if the space between
/// them is less than `headroom` steps, because no body fits there. A column therefore has at most as many spans as
/// storeys, and the order of the triangles has no influence.
class SolidSpans {
public:
    SolidSpans(const ColumnGrid& grid, std::int32_t headroom, double margin);

    const ColumnGrid& grid() const { return grid_; }

    /// Returns the distance from a triangle, along each axis, up to which space counts as solid, in world units.
    double margin() const { return margin_; }

    /// Marks space as solid in each column and height that is within the margin of the triangle, along each axis. The
    /// triangle is clipped to each column (Sutherland and Hodgman 1974). Parts outside the grid are ignored.
    void add(const std::array<glm::dvec3, 3>& corners);

    /// Reads the solid spans of the column (x, z) into `spans`, from the lowest to the highest.
    void read(std::int32_t x, std::int32_t z, std::vector<SolidSpan>& spans) const;

private:
    struct Node {
        SolidSpan span;
        std::uint32_t next = 0;
    };

    void insert(std::int32_t x, std::int32_t z, double low, double high);

    ColumnGrid grid_;
    std::int32_t headroom_;
    double margin_;
    std::vector<std::uint32_t> first_; // by column
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> unused_;
};

} // namespace gnomon::path
