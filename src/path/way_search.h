// The way of a walk over a floor: from where to where there is most to see, and the cells in between.
#pragma once

#include "path/walkable_floor.h"

#include <optional>

namespace gnomon::path {

/// What of a floor a walk may use, and how far it may go; world units.
struct WayBounds {
    double low = -std::numeric_limits<double>::infinity(); // of the floor's height
    double high = std::numeric_limits<double>::infinity();
    double longest = 84;
};

/// Cells that follow each other, and what their way is like.
struct FoundWay {
    std::vector<std::uint32_t> cells;
    double length = 0;   // world units
    double interest = 0; // the longer, the more inside, the more beside things, and over stairs: the more
};

/// How much farther a way through a cell counts as than it is: 1 at ease, 5 where the body just fits, so that ways keep
/// to the middle of corridors and doors; twice as much under the sky, and a third more far from things.
double wayWeight(const WalkableFloor& floor, std::uint32_t cell);

/// The way with the most to see (but for an end that has less than half as much) among those that begin at a few seeded
/// places of the largest connected floors (those inside count more) and lead, as short as can be (Dijkstra 1959 with
/// the buckets of Dial 1969), to where they collect the most within `bounds.longest`; and from there once more, as one
/// finds the two ends of a tree. Further legs go on from its end, without coming back, as long as they have half as
/// much to see. None where no floor can be walked.
std::optional<FoundWay> findWay(const WalkableFloor& floor, const WayBounds& bounds);

} // namespace gnomon::path
