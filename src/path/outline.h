// Points on a model's surface that represent its outline from each direction.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <vector>

namespace gnomon::path {

/// Returns the vertices of a coarse cut of the main part of `model`, in world space. The error of the cut is 1/400 of
/// the diagonal of the main part, or larger if the cut would read more than 16 MiB of pages. Each vertex of a cut is on
/// the surface of the source. The surface extends beyond the vertices by at most the error of the cut. For a damaged
/// page, the function returns the corners of the page's box.
std::vector<glm::dvec3> outlineOf(const hierarchy::ModelFile& model);

/// Estimates the up direction of `model` from its position and shape. A build without a given up direction makes the
/// same estimate. Throws Error for a damaged page.
hierarchy::UpGuess guessedUp(const hierarchy::ModelFile& model);

/// Returns the eight corners of a box. An empty box counts as a point at the origin.
std::vector<glm::dvec3> cornersOf(const Box& box);

/// Returns the points that `outline` reaches in a full turn about the axis along `up` through `center`.
std::vector<glm::dvec3> sweptOutline(
    const std::vector<glm::dvec3>& outline, const glm::dvec3& center, const glm::dvec3& up);

} // namespace gnomon::path
