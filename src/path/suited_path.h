// Camera paths that suit a model, found from its bounds and, for a walk, from where nothing stands in the way.
#pragma once

#include "hierarchy/model_file.h"
#include "path/camera_path.h"

#include <string>

namespace gnomon::path {

/// A path of kind "walk", "orbit", "flyby" or "approach"; y is up, twelve seconds.
/// An approach ends a thousandth of the way before the surface. A walk goes straight, at eye height, along the longest
/// way that is free of geometry between ankle and head and passes closest to things and has much to see to its
/// end, near and far.
/// Throws Error if the model has no free way.
CameraPath suitedPath(const hierarchy::ModelFile& model, const std::string& kind);

} // namespace gnomon::path
