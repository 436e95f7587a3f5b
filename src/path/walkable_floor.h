// The walkable floor of a model: positions where a body can stand, and the steps between them. A position is the top of
// a solid span with free space above it, as in navigation meshes (Recast, Mononen 2009).
#pragma once

#include "path/solid_spans.h"

#include <limits>
#include <vector>

namespace gnomon::path {

/// The dimensions of the walking body, in world units. All are proportional to its eye height.
struct WalkBody {
    double eyeHeight = 1.7;
    double headroom = 1.9;  // required free height above a floor
    double radius = 0.2;    // free radius around the body, at heights from step to headroom
    double step = 0.3;      // max height of a step, up or down
    double longStep = 0.6;  // max width of a gap in the floor that the body steps over
    double barStep = 1.1;   // max width of a gap beside a bar narrower than a foot, for example in a coarse grating
    double stepSlope = 0.9; // max rise over run for more than one step: stairs of 42 degrees, ramps of 45
    double pace = 1.4;      // units per second

    /// Returns the body with this eye height. An adult has 1.7.
    static WalkBody ofEyeHeight(double eyeHeight);
};

/// A cell of the floor: the top of a solid span in a column, with headroom above it.
struct FloorCell {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::int32_t kSky = std::numeric_limits<std::int32_t>::max();

    std::uint32_t column = 0;
    std::int32_t floor = 0;      // height, in steps of the grid
    std::int32_t ceiling = kSky; // next solid above it, or kSky
    std::uint16_t clearance = 0; // distance to the nearest border cell, in half columns, at most kMaxClearance
    /// The neighbouring cells towards -x, -z, +x, +z, or kNone.
    std::array<std::uint32_t, 4> next{kNone, kNone, kNone, kNone};

    static constexpr std::uint16_t kMaxClearance = 0x7FFF;
};

/// All floor cells of a grid, by column and from below.
class WalkableFloor {
public:
    WalkableFloor(const SolidSpans& solid, const WalkBody& body);

    const ColumnGrid& grid() const { return grid_; }

    const WalkBody& body() const { return body_; }

    const std::vector<FloorCell>& cells() const { return cells_; }

    /// Returns true if the body has its free radius at `cell`.
    bool isWalkable(std::uint32_t cell) const { return cells_[cell].clearance >= bodyClearance_; }

    /// Returns true if a ceiling is less than 8 eye heights above the floor of the cell. A higher ceiling counts as
    /// sky.
    bool isInside(std::uint32_t cell) const;

    /// Returns the centre of a cell at floor height, in world space.
    glm::dvec3 position(std::uint32_t cell) const;

    /// Returns the height of a floor at `steps`, in world space.
    double height(std::int32_t steps) const { return grid_.origin.y + (steps - 0.5) * grid_.rise - margin_; }

    /// Returns the distance from a cell to the nearest border cell, in world units.
    double clearance(std::uint32_t cell) const { return 0.5 * cells_[cell].clearance * grid_.cell; }

    /// Returns the column (x, z) of a column index.
    glm::ivec2 placeOf(std::uint32_t column) const;

    /// Returns the cell after two steps around a corner, first in direction `first` and then in direction `second`;
    /// kNone if a step is impossible.
    std::uint32_t around(std::uint32_t cell, std::size_t first, std::size_t second) const;

    /// Returns the cell of column (x, z) whose floor is nearest to `floor`, within `maxDistance` steps; or kNone.
    std::uint32_t nearest(std::int32_t x, std::int32_t z, std::int32_t floor, std::int32_t maxDistance) const;

private:
    void findFloors(const SolidSpans& solid);
    void bridgeGaps(const SolidSpans& solid);
    void bridgeFrom(std::uint32_t cell, bool isAlongX, const SolidSpans& solid, std::vector<FloorCell>& bridges) const;
    void add(std::vector<FloorCell>& more);
    bool isBar(std::uint32_t cell, const glm::ivec2& outwards) const;
    void connect();
    void leaveSteepOnes();
    void measureClearance();
    bool isSteep(std::uint32_t cell) const;
    bool isBorder(std::uint32_t cell) const;

    std::int32_t steps(double height) const { return static_cast<std::int32_t>(height / grid_.rise); }

    ColumnGrid grid_;
    WalkBody body_;
    double margin_ = 0; // extra size of the solid around the geometry
    std::uint16_t bodyClearance_ = 0;
    std::vector<FloorCell> cells_;
    std::vector<std::uint32_t> firstOfColumn_; // one element per column, and the end
};

} // namespace gnomon::path
