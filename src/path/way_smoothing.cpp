#include "path/way_smoothing.h"

#include <algorithm>
#include <cmath>

namespace gnomon::path {

namespace {

constexpr int kRoundings = 120;

WayPoint middleOf(const WalkableFloor& floor, std::uint32_t cell) {
    return {glm::dvec2(floor.placeOf(floor.cells()[cell].column)) + 0.5, cell};
}

/// Returns those points of the route `way` that remain after it is straightened. The straight lines between them cost
/// no more than the route itself.
std::vector<WayPoint> pulledStraight(const WalkableFloor& floor, const std::vector<WayPoint>& way) {
    constexpr std::size_t kFarthest = 256; // max look-ahead, in points
    constexpr double kAsGood = 1.02;
    std::vector<double> cost(way.size(), 0);
    for (std::size_t i = 1; i < way.size(); ++i)
        cost[i] = cost[i - 1] + runStraight(floor, way[i - 1], way[i].at).cost;
    std::vector<WayPoint> pulled{way.front()};
    for (std::size_t i = 0; i + 1 < way.size();) {
        std::size_t next = i + 1;
        for (std::size_t j = std::min(i + kFarthest, way.size() - 1); j > i + 1; --j) {
            const StraightRun run = runStraight(floor, way[i], way[j].at);
            if (run.end != way[j].cell || run.cost > kAsGood * (cost[j] - cost[i])) continue;
            next = j;
            break;
        }
        pulled.push_back(way[next]);
        i = next;
    }
    return pulled;
}

/// Returns points that are evenly spaced on each line of the route `way`, at most `spacing` apart.
std::vector<WayPoint> resampled(const WalkableFloor& floor, const std::vector<WayPoint>& way, double spacing) {
    std::vector<WayPoint> points{way.front()};
    for (std::size_t i = 1; i < way.size(); ++i) {
        const int parts = std::max(1, static_cast<int>(std::ceil(glm::distance(way[i - 1].at, way[i].at) / spacing)));
        for (int part = 1; part < parts; ++part) {
            const glm::dvec2 at = glm::mix(way[i - 1].at, way[i].at, static_cast<double>(part) / parts);
            const std::uint32_t cell = runStraight(floor, points.back(), at).end;
            if (cell != FloorCell::kNone) points.push_back({at, cell});
        }
        points.push_back(way[i]);
    }
    return points;
}

/// Rounds the corners of a route: moves each point half the distance to the midpoint of its neighbours. A point moves
/// only if it then has clearance and the straight lines to both neighbours are free.
void roundOff(const WalkableFloor& floor, std::vector<WayPoint>& points) {
    const double comfort = 0.3 * floor.body().eyeHeight;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const WayPoint& before = points[i - 1];
        const WayPoint& after = points[i + 1];
        WayPoint moved;
        moved.at = 0.5 * points[i].at + 0.25 * (before.at + after.at);
        moved.cell = runStraight(floor, points[i], moved.at).end;
        if (moved.cell == FloorCell::kNone) continue;
        if (floor.clearance(moved.cell) < std::min(comfort, floor.clearance(points[i].cell))) continue;
        if (runStraight(floor, before, moved.at).end != moved.cell) continue;
        if (runStraight(floor, moved, after.at).end != after.cell) continue;
        points[i] = moved;
    }
}

} // namespace

StraightRun runStraight(const WalkableFloor& floor, const WayPoint& from, const glm::dvec2& to) {
    const glm::dvec2 way = to - from.at;
    const double length = glm::length(way);
    glm::ivec2 at(glm::floor(from.at));
    const glm::ivec2 last(glm::floor(to));
    StraightRun run;
    std::uint32_t cell = from.cell;
    double entered = 0; // position on the line, from 0 to 1
    while (at != last) {
        glm::dvec2 leaves(2);
        for (glm::length_t axis = 0; axis < 2; ++axis)
            if (at[axis] != last[axis])
                leaves[axis] = ((way[axis] > 0 ? at[axis] + 1 : at[axis]) - from.at[axis]) / way[axis];
        const glm::length_t axis = leaves.x <= leaves.y ? 0 : 1;
        run.cost += std::max(leaves[axis] - entered, 0.0) * length * wayWeight(floor, cell);
        entered = std::max(entered, leaves[axis]);
        run.free = entered * length;
        const bool isForward = last[axis] > at[axis];
        cell = floor.cells()[cell].next.at(static_cast<std::size_t>(axis) + (isForward ? 2U : 0U));
        if (cell == FloorCell::kNone || !floor.isWalkable(cell)) return run;
        at[axis] += isForward ? 1 : -1;
    }
    run.cost += (1 - entered) * length * wayWeight(floor, cell);
    run.free = length;
    run.end = cell;
    return run;
}

std::vector<WayPoint> smoothWay(const WalkableFloor& floor, const std::vector<std::uint32_t>& cells) {
    std::vector<WayPoint> way;
    way.reserve(cells.size());
    for (const std::uint32_t cell : cells)
        way.push_back(middleOf(floor, cell));
    const double spacing = 0.25 * floor.body().eyeHeight / floor.grid().cell;
    std::vector<WayPoint> points = resampled(floor, pulledStraight(floor, way), spacing);
    for (int i = 0; i < kRoundings; ++i)
        roundOff(floor, points);
    return points;
}

} // namespace gnomon::path
