// The measurements that a user took on a model: their points, and their representation as text, JSON and CSV.
#pragma once

#include "hierarchy/model.h"
#include "inspect/figures.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::inspect {

/// A measured point.
struct Point {
    glm::i64vec3 cell{0};
    double within = 0; // max distance to the intended point, world units
};

/// The points of one measurement, in the order of the user's clicks.
using Measure = std::vector<Point>;

/// The model that measures refer to.
struct Surveyed {
    std::string model; // file name
    hierarchy::Grid grid;
    hierarchy::Unit unit = hierarchy::Unit::Metre;
    glm::dvec3 up{0, 1, 0}; // any length above 0
};

/// Returns the properties of `model` that measurements need. `path` is its file, and `up` is the up direction, of any
/// length above 0.
Surveyed surveyedOf(const std::string& path, const hierarchy::ModelSummary& model, const glm::dvec3& up);

/// Returns the figures of a measure.
Figures figuresOf(const Measure& measure, const Surveyed& of);

/// Returns the results of a measurement as a few short lines, with the precision of the grid.
std::vector<std::string> inWords(const Measure& measure, const Surveyed& of);

/// Returns all measurements as one JSON document. It contains grid, unit and up direction, and for each measurement the
/// points in the source's coordinates and the measured values.
std::string jsonOf(std::span<const Measure> measures, const Surveyed& of);

/// Returns all measurements as a CSV table with one row per point: number of the measurement, index of the point,
/// position, and the measured values up to this point. Numbers read back without loss.
std::string csvOf(std::span<const Measure> measures, const Surveyed& of);

} // namespace gnomon::inspect
