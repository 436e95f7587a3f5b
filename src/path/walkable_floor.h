// Where a body can stand and to where it can step from there: the open spans above solid ones, as navigation meshes
// find them (Recast, Mononen 2009).
#pragma once

#include "path/solid_spans.h"

#include <limits>
#include <vector>

namespace gnomon::path {

/// Who walks: world units, in proportion to the height of the eye.
struct WalkBody {
    double eyeHeight = 1.7;
    double headroom = 1.9;  // what must be free above a floor
    double radius = 0.2;    // what stays free around the body, between step and headroom
    double step = 0.3;      // the highest step, up or down
    double longStep = 0.6;  // the widest gap in a floor that is stepped over
    double barStep = 1.1;   // the same beside a bar, which is narrower than a foot is long: a coarsely made grating
    double stepSlope = 0.9; // rise over run beyond one step: stairs of 42 degrees, ramps of 45
    double pace = 1.4;      // per second

    /// The body whose eye is `eyeHeight` above its floor: that of an adult at 1.7.
    static WalkBody ofEyeHeight(double eyeHeight);
};

/// One place of a floor: the top of a column's solid, with headroom above it.
struct FloorCell {
    static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    static constexpr std::int32_t kSky = std::numeric_limits<std::int32_t>::max();

    std::uint32_t column = 0;
    std::int32_t floor = 0;      // steps of the grid
    std::int32_t ceiling = kSky; // the next solid above it; kSky where there is none
    std::uint16_t clearance = 0; // halves of a column's side to the nearest cell without a way on, at most kMost
    std::array<std::uint32_t, 4> next{kNone, kNone, kNone, kNone}; // to where one steps towards -x, -z, +x, +z

    static constexpr std::uint16_t kMostClearance = 0x7FFF;
};

/// All floor of a grid, in the order of its columns and from below.
class WalkableFloor {
public:
    WalkableFloor(const SolidSpans& solid, const WalkBody& body);

    const ColumnGrid& grid() const { return grid_; }

    const WalkBody& body() const { return body_; }

    const std::vector<FloorCell>& cells() const { return cells_; }

    /// Whether the body keeps its radius there.
    bool isWalkable(std::uint32_t cell) const { return cells_[cell].clearance >= bodyClearance_; }

    /// Whether there is a ceiling: what is no more than a high hall above.
    bool isInside(std::uint32_t cell) const;

    /// The middle of a cell at the height of its floor, world space.
    glm::dvec3 position(std::uint32_t cell) const;

    /// The height of a floor of so many steps, world space.
    double height(std::int32_t steps) const { return grid_.origin.y + (steps - 0.5) * grid_.rise - margin_; }

    /// The distance from a cell to the nearest one without a way on, world units.
    double clearance(std::uint32_t cell) const { return 0.5 * cells_[cell].clearance * grid_.cell; }

    /// Column (x, z) of an index of columns.
    glm::ivec2 placeOf(std::uint32_t column) const;

    /// To where the two steps lead that go around the corner towards `first` and then `second`; kNone if one cannot.
    std::uint32_t around(std::uint32_t cell, std::size_t first, std::size_t second) const;

    /// The cell of column (x, z) whose floor is nearest to `floor`, at most `most` steps off it; or kNone.
    std::uint32_t nearest(std::int32_t x, std::int32_t z, std::int32_t floor, std::int32_t most) const;

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
    double margin_ = 0; // by which the solid is larger than what is there
    std::uint16_t bodyClearance_ = 0;
    std::vector<FloorCell> cells_;
    std::vector<std::uint32_t> firstOfColumn_; // one more than there are columns
};

} // namespace gnomon::path
