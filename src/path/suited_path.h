// Creates default camera paths for a model from its bounds or its surface.
#pragma once

#include "path/walk.h"

#include <string>
#include <vector>

namespace gnomon::path {

/// Returns a camera path around or through `model`. `kind` is "walk", "orbit", "flyby" or "approach". The up direction
/// is that of the model. The path takes twelve seconds, except for a walk. An approach ends at a thousandth of its
/// initial distance to the surface. A walk follows the model's floors (see `walk`) and throws Error if there are none.
CameraPath suitedPath(const hierarchy::ModelFile& model, const std::string& kind, const WalkOptions& walkOptions = {});

/// Returns a camera path that passes one of `cameras` per second, from time 0. The list must not be empty, and all
/// cameras must have the same projection.
CameraPath pathThrough(const std::vector<Camera>& cameras);

} // namespace gnomon::path
