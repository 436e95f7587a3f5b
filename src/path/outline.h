// Computes points on the surface of a model that represent its outline from each direction.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <vector>

namespace gnomon::path {

/// Returns points in world space that represent the surface of `model`: the vertices of a coarse cut of its main part.
/// The error of the cut is 1/400 of the diagonal of the main part, or larger if the cut would read more than 16 MiB of
/// pages. Each vertex is on the surface of the source mesh, and the surface extends beyond the vertices by at most the
/// error of the cut. For a damaged page, the function returns the corners of the page's box.
std::vector<glm::dvec3> outlineOf(const hierarchy::ModelFile& model);

/// Estimates the up direction of `model` from its position on the earth and from its shape. `gnomon build` makes the
/// same estimate if no up direction is given. Throws Error for a damaged page.
hierarchy::UpGuess guessedUp(const hierarchy::ModelFile& model);

/// Returns the eight corners of a box. For an empty box, all eight corners are the origin.
std::vector<glm::dvec3> cornersOf(const Box& box);

/// Returns the points of `outline`, rotated about the axis along `up` through `center` to evenly spaced angles of a
/// full turn.
std::vector<glm::dvec3> sweptOutline(
    const std::vector<glm::dvec3>& outline, const glm::dvec3& center, const glm::dvec3& up);

} // namespace gnomon::path
