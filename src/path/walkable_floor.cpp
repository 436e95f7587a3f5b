#include "path/walkable_floor.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon::path {

namespace {

constexpr double kHighestCeiling = 8; // in eye heights: a higher ceiling counts as sky
constexpr std::array<std::int32_t, 4> kStepX{-1, 0, 1, 0};
constexpr std::array<std::int32_t, 4> kStepZ{0, -1, 0, 1};

} // namespace

WalkBody WalkBody::ofEyeHeight(double eyeHeight) {
    WalkBody body;
    const double scale = eyeHeight / body.eyeHeight;
    for (double* length :
         {&body.eyeHeight, &body.headroom, &body.radius, &body.step, &body.longStep, &body.barStep, &body.pace})
        *length *= scale;
    return body;
}

WalkableFloor::WalkableFloor(const SolidSpans& solid, const WalkBody& body)
    : grid_(solid.grid()),
      body_(body),
      margin_(solid.margin()),
      bodyClearance_(static_cast<std::uint16_t>(std::max(2.0, 2 * std::ceil(body.radius / grid_.cell - 1e-9)))) {
    findFloors(solid);
    bridgeGaps(solid);
    connect();
    leaveSteepOnes();
    measureClearance();
}

bool WalkableFloor::isInside(std::uint32_t cell) const {
    const FloorCell& at = cells_[cell];
    return at.ceiling != FloorCell::kSky && (at.ceiling - at.floor) * grid_.rise < kHighestCeiling * body_.eyeHeight;
}

glm::dvec3 WalkableFloor::position(std::uint32_t cell) const {
    const FloorCell& at = cells_[cell];
    const glm::dvec2 middle = (glm::dvec2(placeOf(at.column)) + 0.5) * grid_.cell;
    return {grid_.origin.x + middle.x, height(at.floor), grid_.origin.z + middle.y};
}

std::uint32_t WalkableFloor::around(std::uint32_t cell, std::size_t first, std::size_t second) const {
    const std::uint32_t beside = cells_[cell].next[first];
    return beside == FloorCell::kNone ? FloorCell::kNone : cells_[beside].next[second];
}

std::uint32_t WalkableFloor::nearest(
    std::int32_t x, std::int32_t z, std::int32_t floor, std::int32_t maxDistance) const {
    if (x < 0 || z < 0 || x >= grid_.width || z >= grid_.depth) return FloorCell::kNone;
    const std::size_t column =
        static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.width) + static_cast<std::size_t>(x);
    std::uint32_t found = FloorCell::kNone;
    for (std::uint32_t i = firstOfColumn_[column]; i < firstOfColumn_[column + 1]; ++i) {
        const std::int32_t away = std::abs(cells_[i].floor - floor);
        if (away > maxDistance || (found != FloorCell::kNone && away >= std::abs(cells_[found].floor - floor)))
            continue;
        found = i;
    }
    return found;
}

void WalkableFloor::findFloors(const SolidSpans& solid) {
    std::vector<SolidSpan> spans;
    std::vector<FloorCell> found;
    std::uint32_t column = 0;
    for (std::int32_t z = 0; z < grid_.depth; ++z)
        for (std::int32_t x = 0; x < grid_.width; ++x, ++column) {
            solid.read(x, z, spans);
            for (std::size_t i = 0; i < spans.size(); ++i) {
                FloorCell cell;
                cell.column = column;
                cell.floor = spans[i].top;
                // There is enough headroom above this floor, because spans with less free height between them are
                // merged.
                if (i + 1 < spans.size()) cell.ceiling = spans[i + 1].bottom;
                found.push_back(cell);
            }
        }
    add(found);
}

void WalkableFloor::add(std::vector<FloorCell>& more) {
    const auto isBefore = [](const FloorCell& a, const FloorCell& b) {
        return a.column != b.column ? a.column < b.column : a.floor < b.floor;
    };
    if (!std::is_sorted(more.begin(), more.end(), isBefore)) std::sort(more.begin(), more.end(), isBefore);
    const auto middle = static_cast<std::ptrdiff_t>(cells_.size());
    cells_.insert(cells_.end(), more.begin(), more.end());
    std::inplace_merge(cells_.begin(), cells_.begin() + middle, cells_.end(), isBefore);
    firstOfColumn_.assign(grid_.columnCount() + 1, 0);
    for (const FloorCell& cell : cells_)
        ++firstOfColumn_[cell.column + 1];
    for (std::size_t i = 1; i < firstOfColumn_.size(); ++i)
        firstOfColumn_[i] += firstOfColumn_[i - 1];
}

/// Adds floor over gaps between two floors of equal height. A gap can be as wide as a long stride. It can be wider
/// beside a bar, because a grating consists of bars and gaps.
void WalkableFloor::bridgeGaps(const SolidSpans& solid) {
    for (const bool isAlongX : {true, false}) {
        std::vector<FloorCell> bridges;
        const auto count = static_cast<std::uint32_t>(cells_.size());
        for (std::uint32_t cell = 0; cell < count; ++cell)
            bridgeFrom(cell, isAlongX, solid, bridges);
        add(bridges);
    }
}

glm::ivec2 WalkableFloor::placeOf(std::uint32_t column) const {
    const auto width = static_cast<std::uint32_t>(grid_.width);
    return {static_cast<int>(column % width), static_cast<int>(column / width)};
}

bool WalkableFloor::isBar(std::uint32_t cell, const glm::ivec2& outwards) const {
    const auto broad = std::max(1, static_cast<int>(0.18 * body_.eyeHeight / grid_.cell));
    const glm::ivec2 place = placeOf(cells_[cell].column);
    for (int i = 1; i <= broad; ++i) {
        const glm::ivec2 at = place + i * outwards;
        if (nearest(at.x, at.y, cells_[cell].floor, steps(body_.step)) == FloorCell::kNone) return true;
    }
    return false;
}

void WalkableFloor::bridgeFrom(
    std::uint32_t cell, bool isAlongX, const SolidSpans& solid, std::vector<FloorCell>& bridges) const {
    const FloorCell& from = cells_[cell];
    const glm::ivec2 place = placeOf(from.column);
    const glm::ivec2 along = isAlongX ? glm::ivec2(1, 0) : glm::ivec2(0, 1);
    const auto reach = static_cast<std::int32_t>(body_.barStep / grid_.cell);
    const std::int32_t step = steps(body_.step);
    std::int32_t gap = 0; // number of columns in the gap
    std::uint32_t to = FloorCell::kNone;
    for (; gap <= reach; ++gap) {
        const glm::ivec2 at = place + (gap + 1) * along;
        to = nearest(at.x, at.y, from.floor, step);
        if (to != FloorCell::kNone) break;
    }
    if (to == FloorCell::kNone || gap < 1 || std::abs(cells_[to].floor - from.floor) > step / 3) return;
    if (gap * grid_.cell > body_.longStep && !isBar(cell, -along) && !isBar(to, along)) return;
    FloorCell bridge;
    bridge.floor = std::max(from.floor, cells_[to].floor);
    const std::size_t before = bridges.size();
    std::vector<SolidSpan> spans;
    for (std::int32_t i = 1; i <= gap; ++i) {
        const glm::ivec2 at = place + i * along;
        bridge.column = static_cast<std::uint32_t>(at.y * grid_.width + at.x);
        solid.read(at.x, at.y, spans);
        bridge.ceiling = FloorCell::kSky;
        for (const SolidSpan& span : spans)
            if (span.top > bridge.floor) bridge.ceiling = std::min(bridge.ceiling, span.bottom);
        if (bridge.ceiling != FloorCell::kSky && bridge.ceiling - bridge.floor < steps(body_.headroom)) {
            bridges.resize(before); // an obstacle stands in the gap
            return;
        }
        bridges.push_back(bridge);
    }
}

void WalkableFloor::connect() {
    const std::int32_t headroom = steps(body_.headroom);
    const std::int32_t step = steps(body_.step);
    for (FloorCell& cell : cells_) {
        const glm::ivec2 at = placeOf(cell.column);
        for (std::size_t i = 0; i < cell.next.size(); ++i) {
            const std::uint32_t found = nearest(at.x + kStepX.at(i), at.y + kStepZ.at(i), cell.floor, step);
            if (found == FloorCell::kNone) continue;
            const FloorCell& other = cells_[found];
            const std::int32_t ceiling = std::min(cell.ceiling, other.ceiling);
            if (ceiling == FloorCell::kSky || ceiling - std::max(cell.floor, other.floor) >= headroom)
                cell.next.at(i) = found;
        }
    }
    // Removes one-way connections between cells, in which the other cell is connected to a third cell.
    for (std::uint32_t i = 0; i < cells_.size(); ++i)
        for (std::size_t side = 0; side < 4; ++side) {
            std::uint32_t& next = cells_[i].next.at(side);
            if (next != FloorCell::kNone && cells_[next].next.at((side + 2) % 4) != i) next = FloorCell::kNone;
        }
}

/// Returns true if the floor at `cell` is steeper than stairs, over at least half a stride to either side.
bool WalkableFloor::isSteep(std::uint32_t cell) const {
    const auto reach = static_cast<int>(std::max(1.0, 0.5 * body_.eyeHeight / 1.7 / grid_.cell));
    glm::dvec2 slope(0);
    for (std::size_t axis = 0; axis < 2; ++axis) {
        std::array<std::uint32_t, 2> ends{cell, cell};
        int taken = 0;
        for (std::size_t side = 0; side < 2; ++side)
            for (int i = 0; i < reach && cells_[ends.at(side)].next.at(axis + 2 * side) != FloorCell::kNone;
                 ++i, ++taken)
                ends.at(side) = cells_[ends.at(side)].next.at(axis + 2 * side);
        const double rise = std::abs(cells_[ends[0]].floor - cells_[ends[1]].floor) * grid_.rise;
        const double excessRise = std::max(0.0, rise - 0.7 * body_.step);
        slope[static_cast<glm::length_t>(axis)] = excessRise / (std::max(taken, 1) * grid_.cell);
    }
    return glm::length(slope) > body_.stepSlope;
}

void WalkableFloor::leaveSteepOnes() {
    std::vector<std::uint32_t> steep;
    for (std::uint32_t i = 0; i < cells_.size(); ++i)
        if (isSteep(i)) steep.push_back(i);
    for (const std::uint32_t i : steep)
        for (std::size_t side = 0; side < 4; ++side) {
            std::uint32_t& next = cells_[i].next.at(side);
            if (next != FloorCell::kNone) cells_[next].next.at((side + 2) % 4) = FloorCell::kNone;
            next = FloorCell::kNone;
        }
}

bool WalkableFloor::isBorder(std::uint32_t cell) const {
    for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t turned = (side + 1) % 4;
        const std::uint32_t corner = around(cell, side, turned);
        if (corner == FloorCell::kNone || corner != around(cell, turned, side)) return true;
    }
    return false;
}

/// Computes the distance of each cell to the nearest border of the floor in two sweeps, with cost 2 for straight and 3
/// for diagonal steps (Borgefors 1986). Distances follow the connections between cells.
void WalkableFloor::measureClearance() {
    for (std::uint32_t i = 0; i < cells_.size(); ++i)
        cells_[i].clearance = isBorder(i) ? 0 : FloorCell::kMaxClearance;
    const auto lower = [&](FloorCell& cell, std::uint32_t other, int cost) {
        if (other == FloorCell::kNone) return;
        cell.clearance = static_cast<std::uint16_t>(std::min<int>(cell.clearance, cells_[other].clearance + cost));
    };
    const auto sweep = [&](std::uint32_t i, std::size_t x, std::size_t z) {
        FloorCell& cell = cells_[i];
        lower(cell, cell.next.at(x), 2);
        lower(cell, cell.next.at(z), 2);
        lower(cell, around(i, z, x), 3);
        lower(cell, around(i, z, (x + 2) % 4), 3);
    };
    for (std::uint32_t i = 0; i < cells_.size(); ++i)
        sweep(i, 0, 1);
    for (auto i = static_cast<std::uint32_t>(cells_.size()); i-- > 0;)
        sweep(i, 2, 3);
}

} // namespace gnomon::path
