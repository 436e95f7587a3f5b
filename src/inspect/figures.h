// Computes distances, heights, angles and areas of points. All steps before the last root or quotient are computed
// with integers.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::inspect {

/// Max distance between two measured points, in grid steps. With this limit, products fit in 128-bit integers.
constexpr std::int64_t kMaxSteps = std::int64_t{1} << 40;

/// The distances, heights, angles and areas of a sequence of points, in world units and degrees. A value that needs
/// more points is 0 or empty.
struct Figures {
    std::vector<double> legs;                         // length from each point to the next
    double along = 0;                                 // sum of the legs
    double straight = 0;                              // distance from the first point to the last
    double height = 0;                                // height of the last point above the first; negative if below
    double level = 0;                                 // horizontal length of `straight`
    double slopeDegrees = 0;                          // slope of `straight`, from -90 to 90
    std::vector<std::optional<double>> anglesDegrees; // angle at each inner point; nullopt if a leg has no length
    double perimeter = 0;                             // length of the closed polygon
    double area = 0;     // length of the polygon's vector area (Newell); for a planar polygon the enclosed area
    double planArea = 0; // horizontal area, seen from above
    double offPlane = 0; // max distance of the points from their mean plane; 0 without a plane
};

/// Returns the measured values of the points `cells`, which are in steps of a grid. Two points are at most kMaxSteps
/// apart. `step` is the grid step in world units, a power of two. `up` has any length above 0. Squared distances and
/// vector areas are integers, so derived values have the full precision of a double.
Figures figuresOf(std::span<const glm::i64vec3> cells, double step, const glm::dvec3& up);

} // namespace gnomon::inspect
