// Extracts the shadow maps of a frame as depth pictures.
#pragma once

#include "render/backend.h"

#include <string>
#include <vector>

namespace gnomon::render {

/// A depth picture and the path of the file to which it is written.
struct NamedDepths {
    std::string path;
    FloatPicture depths;
};

/// Returns each shadow map of `plan` as a depth picture. `backend` must have drawn the plan just before. The file name
/// of a map contains its slice and face.
std::vector<NamedDepths> shadowMaps(const plan::FramePlan& plan, Backend& backend);

} // namespace gnomon::render
