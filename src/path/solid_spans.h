// Where a model is solid: spans of height, column by column, as navigation meshes start from (Recast, Mononen 2009).
#pragma once

#include "core/box.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::path {

/// Heights in steps of the grid, half-open.
struct SolidSpan {
    std::int32_t bottom = 0;
    std::int32_t top = 0;
};

/// Square columns over a region and the steps in which heights count; world units, y up.
struct ColumnGrid {
    glm::dvec3 origin{0}; // of column (0, 0), at height 0
    double cell = 0.1;    // a column's side
    double rise = 0.02;   // one step of height
    std::int32_t width = 0;
    std::int32_t depth = 0;

    /// Columns of `side` that cover `region`, and steps of height `step`.
    ColumnGrid(const Box& region, double side, double step);

    std::size_t columnCount() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(depth); }
};

/// The solid spans over a grid. Spans with less than `headroom` steps between them count as one, for nobody stands
/// there: so a column holds at most as many spans as storeys fit, whatever the model, and the order of triangles makes
/// no difference.
class SolidSpans {
public:
    SolidSpans(const ColumnGrid& grid, std::int32_t headroom, double margin);

    const ColumnGrid& grid() const { return grid_; }

    /// How far around a triangle all is solid, world units.
    double margin() const { return margin_; }

    /// Makes solid every column and height that come nearer than the margin to the triangle, along each axis (the
    /// triangle is clipped to each column, Sutherland and Hodgman 1974); what lies beside the grid is left out.
    void add(const std::array<glm::dvec3, 3>& corners);

    /// The spans of column (x, z), from below.
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
    std::vector<std::uint32_t> first_; // of each column
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> unused_;
};

} // namespace gnomon::path
