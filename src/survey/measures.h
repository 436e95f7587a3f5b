// Measures that a person took of a model: their points, and how they are told and kept.
#pragma once

#include "hierarchy/model.h"
#include "survey/figures.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::survey {

/// A point that was measured.
struct Point {
    glm::i64vec3 cell{0};
    double within = 0; // world units: how far at most it is from what it stands for
};

/// Points in the order in which they were taken.
using Measure = std::vector<Point>;

/// What measures are of.
struct Surveyed {
    std::string model; // its file
    hierarchy::Grid grid;
    hierarchy::Unit unit = hierarchy::Unit::Metre;
    glm::dvec3 up{0, 1, 0}; // any length above 0
};

/// What `model`, in the file `path`, is measured by; `up` is what is up there, of any length above 0.
Surveyed surveyedOf(const std::string& path, const hierarchy::ModelSummary& model, const glm::dvec3& up);

/// The figures of a measure.
Figures figuresOf(const Measure& measure, const Surveyed& of);

/// A measure in a few short lines, with as many digits as the grid has.
std::vector<std::string> inWords(const Measure& measure, const Surveyed& of);

/// All of them as one JSON document: grid, unit, up; then of each the points in the source's coordinates and the
/// figures.
std::string jsonOf(std::span<const Measure> measures, const Surveyed& of);

/// A row a point behind a head: its number and place, and what the points measure up to it. Numbers read back as they
/// are.
std::string csvOf(std::span<const Measure> measures, const Surveyed& of);

} // namespace gnomon::survey
