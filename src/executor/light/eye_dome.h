// Creases and outlines from depth alone, for surfaces that the light does not tell apart.
#pragma once

#include "executor/picture.h"

namespace gnomon::executor {

/// Darkens the pixels of `picture` that lie behind what is around them, as eye-dome lighting does (Boucheny 2009), by
/// depths of the same size, infinite where nothing is. Of each two opposite pixels the mean of 1/depth is compared:
/// that of a plane is its own, so that no flat surface darkens however it lies. Where nothing is, nothing changes.
void darkenHollows(Picture& picture, const FloatPicture& depth);

} // namespace gnomon::executor
