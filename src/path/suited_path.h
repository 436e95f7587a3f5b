// Camera paths that suit a model, found from its bounds or its surface.
#pragma once

#include "path/walk.h"

#include <string>
#include <vector>

namespace gnomon::path {

/// A path of kind "walk", "orbit", "flyby" or "approach"; what is up in the model is up, twelve seconds but for a walk.
/// An approach ends a thousandth of the way before the surface. A walk goes over the model's floors as `walk` says,
/// and throws Error where there are none.
CameraPath suitedPath(const hierarchy::ModelFile& model, const std::string& kind, const WalkOptions& walkOptions = {});

/// Returns a path with the cameras, at least one and all of one projection, at seconds 0, 1, 2, ...
CameraPath pathThrough(const std::vector<Camera>& cameras);

} // namespace gnomon::path
