// What a surface looks like if one of the six axis directions is up: numbers that say how well it stands that way.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::hierarchy {

/// The directions +x, -x, +y, -y, +z, -z.
constexpr int kUpDirections = 6;

/// Numbers of one direction. "Lowest" and "below" are seen with this direction up; the outline is the convex hull of
/// the surface seen along the axis; columns are the cells of a square grid of 48 x 48 across the axis that contain
/// surface.
enum class UpFeature : std::size_t {
    Base,         // area of the hull of the vertices in the lowest 2% of the height, of the outline
    Balance,      // how deep the middle of the surface is within that hull, of how deep it is within the outline
    MiddleHeight, // height of the middle of the surface, of the height
    Sole,         // level area in the lowest 2.5%, of the outline
    Facing,       // sum of the area vectors along the direction, of the outline: 0 for a closed surface
    Level,        // share of the area that is level within 10 degrees
    Wall,         // share of the area that is upright within 10 degrees
    Mirror,       // overlap with the surface mirrored from bottom to top
    Turn,         // overlap with the surface turned by a quarter around the axis
    Contact,      // share of the columns that reach into the lowest 3%
    Feet,         // connected parts of these columns
    Gap,          // mean height of the lowest surface of the columns, of the height
    LevelBelow,   // share of the columns whose lowest surface is level within 20 degrees
    LowHull,      // area of the hull of the lowest quarter, of the outline
    LegParts,     // connected parts of the columns between 3% and 15% of the height
    LegCells,     // share of the columns that these are
    BodyParts,    // the same between 15% and 35%
    BodyCells,
    Lowest,      // share of the area in the lowest tenth
    Low,         // from there to 30%
    Middle,      // from there to the middle of the height
    LevelUp,     // share of the area that is level within 20 degrees and faces up
    Height,      // of the longest extent
    Slenderness, // height by the side of a square as large as the outline
    Area,        // of the outline
    Count
};

constexpr auto kUpFeatures = static_cast<std::size_t>(UpFeature::Count);

/// What is compared between directions: the feature; less that of the opposite direction; less the largest and the
/// smallest of the four directions across.
constexpr std::size_t kUpNumbers = 4 * kUpFeatures;

using UpNumbers = std::array<float, kUpNumbers>;

/// Returns the numbers of each direction. A surface that is turned to another axis has the same numbers, turned
/// likewise, up to rounding. `triangles` are corners in any unit. Empty for a surface without area or of no extent.
std::vector<UpNumbers> upNumbers(std::span<const std::array<glm::vec3, 3>> triangles);

} // namespace gnomon::hierarchy
