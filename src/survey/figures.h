// Distances, heights, angles and areas of points: whole numbers until the last root or quotient.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace gnomon::survey {

/// How many steps of the grid may lie between two cells that are measured: their products stay whole numbers of 128
/// bits.
constexpr std::int64_t kMostSteps = std::int64_t{1} << 40;

/// What points in a row measure, world units and degrees. What takes more points than there are is 0 or empty.
struct Figures {
    std::vector<double> legs;                         // from each point to the next
    double along = 0;                                 // the sum of the legs
    double straight = 0;                              // from the first point to the last
    double height = 0;                                // of the last above the first; below 0: beneath it
    double level = 0;                                 // `straight` as seen from above
    double slopeDegrees = 0;                          // of `straight` to the level, from -90 to 90
    std::vector<std::optional<double>> anglesDegrees; // at each inner point; nothing where a leg has no length
    double perimeter = 0;                             // of the closed polygon, as is:
    double area = 0;     // of its vector area (Newell), which for a level polygon is the one that it encloses
    double planArea = 0; // as seen from above
    double offPlane = 0; // how far its points lie from its mean plane, at most; 0 where it has none
};

/// The figures of `cells`, at most kMostSteps apart, on a grid of `step`, a power of two; `up` has any length above 0.
/// Squares of distances and vector areas are whole numbers: what is told of them is as good as a double is.
Figures figuresOf(std::span<const glm::i64vec3> cells, double step, const glm::dvec3& up);

} // namespace gnomon::survey
