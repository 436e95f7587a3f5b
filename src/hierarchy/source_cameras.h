// The cameras that the source mesh of a model contains. The model file stores them as text among the build options.
#pragma once

#include "core/camera.h"
#include "hierarchy/model_file.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::hierarchy {

/// The key under which ModelSummary::options stores the cameras. The key is absent if the source has no camera.
inline constexpr const char* kCamerasOption = "cameras";

/// Returns the text that a model file stores for `cameras`. Each camera is one line with projection, eye, target, up,
/// and the full vertical field of view in radians.
std::string camerasText(std::span<const Camera> cameras);

/// Returns how many cameras from its source the model stores.
std::size_t cameraCount(const ModelSummary& summary);

/// Returns the cameras from its source that the model stores. Throws Error if the stored text is damaged.
std::vector<Camera> camerasOf(const ModelFile& model);

} // namespace gnomon::hierarchy
