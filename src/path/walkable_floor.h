// The walkable floor of a model: positions where a person can stand, and the steps between them. A position is the top
// of a solid range of heights with free space above it, as in navigation meshes (Recast, Mononen 2009).
#pragma once

#include "path/solid_spans.h"

#include <limits>
#include <vector>

namespace gnomon::path {

/// The dimensions of the walking person, in world units. All are proportional to the eye height.
struct WalkBody {
    double eyeHeight = 1.7;
    double headroom = 1.9;  // required free height above a floor
    double radius = 0.2;    // free radius around the body, at heights from step to headroom
    double step = 0.3;      // max height of a step, up or down
    double longStep = 0.6;  // max width of a gap in the floor that the body steps over
    double barStep = 1.1;   // max width of a gap beside a bar narrower than a foot, for example in a coarse grating
    double stepSlope = 0.9; // max rise over run for more than one step: stairs of 42 degrees, ramps of 45
    double pace = 1.4;      // units per second

    /// Returns the dimensions of a person with this eye height. An adult has an eye height of 1.7.
    static WalkBody ofEyeHeight(double eyeHeight);
};

/// A cell of the floor where a person can stand: the top of a solid range of heights in a column, with free space above
/// it.
struct FloorCell {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::int32_t kSky = std::numeric_limits<std::int32_t>::max();

    std::uint32_t column = 0;
    std::int32_t floor = 0;      // height, in steps of the grid
    std::int32_t ceiling = kSky; // next solid above it, or kSky
    std::uint16_t clearance = 0; // distance to the nearest border cell, in half columns, at most kMaxClearance
    /// Indices of the neighbouring cells towards -x, -z, +x and +z, or kNone.
    std::array<std::uint32_t, 4> next{kNone, kNone, kNone, kNone};

    static constexpr std::uint16_t kMaxClearance = 0x7FFF;
};

/// All floor cells of a grid of columns, sorted by column and from below.
class WalkableFloor {
public:
    WalkableFloor(const SolidSpans& solid, const WalkBody& body);

    const ColumnGrid& grid() const { return grid_; }

    const WalkBody& body() const { return body_; }

    const std::vector<FloorCell>& cells() const { return cells_; }

    /// Returns true if a person's free radius fits at `cell`, so that the person can walk there.
    bool isWalkable(std::uint32_t cell) const { return cells_[cell].clearance >= bodyClearance_; }

    /// Returns true if there is a ceiling less than 8 eye heights above the floor of `cell`. A higher ceiling counts as
    /// sky.
    bool isInside(std::uint32_t cell) const;

    /// Returns the world-space centre of a cell at the height of the floor.
    glm::dvec3 position(std::uint32_t cell) const;

    /// Converts the height of a floor from steps of the grid to world space.
    double height(std::int32_t steps) const { return grid_.origin.y + (steps - 0.5) * grid_.rise - margin_; }

    /// Returns the distance from a cell to the nearest cell at a border of the floor, in world units.
    double clearance(std::uint32_t cell) const { return 0.5 * cells_[cell].clearance * grid_.cell; }

    /// Returns the position (x, z) in the grid of the column with index `column`.
    glm::ivec2 placeOf(std::uint32_t column) const;

    /// Returns the cell that a person reaches with two steps around a corner: one in direction `first`, then one in
    /// direction `second`. Returns kNone if a step is impossible.
    std::uint32_t around(std::uint32_t cell, std::size_t first, std::size_t second) const;

    /// Returns the cell of column (x, z) whose floor height is nearest to `floor`. Returns kNone if no cell is within
    /// `maxDistance` height steps.
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
