// Computes features of a surface that show which of the six axis directions is probably up.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::hierarchy {

/// The number of candidates for the up direction: +x, -x, +y, -y, +z, -z.
constexpr int kUpDirections = 6;

/// The features by which one of the candidates for the up direction is judged. "Lowest" and "below" assume that this
/// direction is up. The outline is the convex hull of the surface, projected along the axis. The columns are those
/// cells of a 48 x 48 grid perpendicular to the axis that contain surface.
enum class UpFeature : std::size_t {
    Base,         // area of the convex hull of the vertices in the lowest 2% of the height, relative to the outline
    Balance,      // depth of the surface's centroid inside that hull, relative to its depth inside the outline
    MiddleHeight, // height of the centroid, relative to the height of the surface
    Sole,         // area of level surface in the lowest 2.5% of the height, relative to the outline
    // Component of the summed area vectors of all triangles along the direction, relative to the outline. It is 0 for
    // a closed surface.
    Facing,
    Level,      // share of the area that is level within 10 degrees
    Wall,       // share of the area that is vertical within 10 degrees
    Mirror,     // overlap with the surface mirrored upside down
    Turn,       // overlap with the surface rotated by 90 degrees around the axis
    Contact,    // share of the columns that have surface in the lowest 3% of the height
    Feet,       // number of connected parts of the Contact columns
    Gap,        // mean height of the lowest surface in each column, relative to the height of the surface
    LevelBelow, // share of the columns whose lowest surface is level within 20 degrees
    LowHull,    // area of the convex hull of the lowest quarter, relative to the outline
    LegParts,   // number of connected parts of the columns between 3% and 15% of the height
    LegCells,   // share of the columns that have surface between 3% and 15% of the height
    BodyParts,  // number of connected parts of the columns between 15% and 35% of the height
    BodyCells,
    Lowest,      // share of the area in the lowest 10% of the height
    Low,         // share of the area between 10% and 30% of the height
    Middle,      // share of the area between 30% and 50% of the height
    LevelUp,     // share of the area that is level within 20 degrees and faces up
    Height,      // height of the surface, relative to its longest extent
    Slenderness, // height of the surface, relative to the side of a square with the area of the outline
    Area,        // area of the surface, relative to the outline
    Count
};

constexpr auto kUpFeatures = static_cast<std::size_t>(UpFeature::Count);

/// The number of values per candidate direction. Each feature has four: its value, the difference to its value for the
/// opposite direction, and the differences to the max and the min of its values for the four perpendicular directions.
constexpr std::size_t kUpNumbers = 4 * kUpFeatures;

using UpNumbers = std::array<float, kUpNumbers>;

/// Returns the feature values of each candidate direction. If the surface is rotated to another axis, the values move
/// to the rotated directions, except for rounding errors. `triangles` contains the corners of the triangles in any
/// unit. Returns an empty list if the surface has no area or no extent.
std::vector<UpNumbers> upNumbers(std::span<const std::array<glm::vec3, 3>> triangles);

} // namespace gnomon::hierarchy
