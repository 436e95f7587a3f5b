// Creases and outlines from depth alone, for surfaces that the light does not tell apart.
#pragma once

#include "executor/picture.h"

namespace gnomon::executor {

/// Darkens the pixels of `picture` that lie behind what is around them, as eye-dome lighting does (Boucheny 2009), by
/// depths of the same size, infinite where nothing is. Of each two opposite pixels the mean of 1/depth is compared:
/// that of a plane is its own, so that no flat surface darkens however it lies. Where nothing is, nothing changes.
/// Lines of sight that are parallel have no distance to compare with, and planes the mean of depth: `parallelDistance`
/// above 0 takes its place, as if all lay about so far away.
void darkenHollows(Picture& picture, const FloatPicture& depth, double parallelDistance = 0);

} // namespace gnomon::executor
