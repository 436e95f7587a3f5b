// Searches the floor of a model for a walk: the start, the end, and the cells in between, with the most interesting
// views.
#pragma once

#include "path/walkable_floor.h"

#include <optional>

namespace gnomon::path {

/// The limits of a walk: the range of floor heights, and the max length in world units.
struct WayBounds {
    double low = -std::numeric_limits<double>::infinity(); // min height of the floor
    double high = std::numeric_limits<double>::infinity();
    double longest = 84;
};

/// A sequence of adjacent floor cells that forms a walk, with its length and interest.
struct FoundWay {
    std::vector<std::uint32_t> cells;
    double length = 0;   // world units
    double interest = 0; // a score: higher for longer ways, indoors, near objects and over stairs
};

/// Returns the cost factor of walking through a cell. It is 1 in open space and 5 where a person just fits, so that
/// shortest paths stay in the middle of corridors and doors. It is twice as large outdoors, and a third larger far from
/// objects.
double wayWeight(const WalkableFloor& floor, std::uint32_t cell);

/// Returns the walk with the most interest, or nothing if no floor is walkable. The search begins at a few seeded
/// positions on the largest connected floors, where indoor floor counts more. Shortest paths (Dijkstra 1959, with the
/// buckets of Dial 1969) lead to the cell with the most interest within `bounds.longest`. From that cell the search
/// starts again, as in the search for the longest path of a tree. The last part of a walk is removed if its interest
/// per length is less than half of that of the whole walk. Further legs continue from the end, without a return over
/// the same floor, if their interest per length is more than half of that of the walk.
std::optional<FoundWay> findWay(const WalkableFloor& floor, const WayBounds& bounds);

} // namespace gnomon::path
