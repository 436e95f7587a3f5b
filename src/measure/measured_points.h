// Measuring without a window: points by their coordinates, or by the pixels of a view in which they are seen.
#pragma once

#include "settings/settings.h"
#include "survey/measures.h"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::measure {

/// Which points: those at `points`, in the source's coordinates, or those that the middles of `pixels` show, columns
/// and rows from the upper left of the picture that `settings` ask for.
struct PointTask {
    std::string model;
    settings::Settings settings;
    std::function<void(const std::string&)> warn;
    std::vector<glm::dvec3> points;
    std::vector<glm::ivec2> pixels;
    bool takesVertices = false; // of the triangles that are drawn there: the nearest
};

struct MeasuredPoints {
    survey::Surveyed of;
    survey::Measure measure;
};

/// Measures them. Throws Error where a pixel shows nothing of the model, and where a point lies so far from it that the
/// grid's steps to there cannot be counted.
MeasuredPoints measurePoints(const PointTask& task);

} // namespace gnomon::measure
