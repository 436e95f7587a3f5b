// The cameras of a model's source. The model file stores them as text among the build options.
#pragma once

#include "core/camera.h"
#include "hierarchy/model_file.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// The key of the cameras in ModelSummary::options. The key is absent if the source has no camera.
inline constexpr const char* kCamerasOption = "cameras";

/// Returns a text with one line per camera: projection, eye, target, up, and the full vertical field of view in
/// radians.
std::string camerasText(std::span<const Camera> cameras);

/// Returns the number of cameras that the model stores.
std::size_t cameraCount(const ModelSummary& summary);

/// Returns the cameras that the model stores. Throws Error if the stored text is damaged.
std::vector<Camera> camerasOf(const ModelFile& model);

} // namespace gnomon::hierarchy
