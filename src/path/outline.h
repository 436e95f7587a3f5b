// Points of a model's surface from which its outline can be told, whichever side it is seen from.
#pragma once

#include "hierarchy/model_file.h"
#include "hierarchy/up_guess.h"

#include <vector>

namespace gnomon::path {

/// The vertices of a coarse cut of the main part of `model`, world space: a cut whose error is 1/400 of the diagonal of
/// the main part, or as much more as it takes to read 16 MiB of pages at most. Every vertex of a cut lies on the
/// source's surface, and the surface no further beyond them than that error. Of a page that is damaged it takes the
/// corners of its box.
std::vector<glm::dvec3> outlineOf(const hierarchy::ModelFile& model);

/// Which way is up in `model` by its place and its shape, as a build that is told nothing guesses it. Throws Error for
/// a page that is damaged.
hierarchy::UpGuess guessedUp(const hierarchy::ModelFile& model);

/// The corners of a box, of any if it is empty.
std::vector<glm::dvec3> cornersOf(const Box& box);

/// `outline` as it is swept when its world turns about the axis along `up` through `center`.
std::vector<glm::dvec3> sweptOutline(
    const std::vector<glm::dvec3>& outline, const glm::dvec3& center, const glm::dvec3& up);

} // namespace gnomon::path
