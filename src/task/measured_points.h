// Measures points of a model without a window. The points are given by coordinates or by pixels of a view.
#pragma once

#include "inspect/measures.h"
#include "settings/settings.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::task {

/// The points of a model to measure. If `pixels` is empty, the points are `points`. Otherwise they are the surface
/// points that the centres of `pixels` show in the view of `settings`.
struct PointTask {
    std::string model;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    std::vector<glm::dvec3> points; // in the coordinates of the source
    std::vector<glm::ivec2> pixels; // column and row from the upper left
    bool takesVertices = false;     // uses the nearest vertex of the drawn triangle instead of the surface point
};

/// The measurements between points, and the model to which they refer.
struct MeasuredPoints {
    inspect::Surveyed of;
    inspect::Measure measure;
};

/// Measures the points of `task` and returns the results. Throws Error if a pixel shows the background, or if a point
/// is too far from the model for its grid (more than 2^39 steps).
MeasuredPoints measurePoints(const PointTask& task);

} // namespace gnomon::task
