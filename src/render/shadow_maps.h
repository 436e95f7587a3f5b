// The shadow maps of a frame as pictures.
#pragma once

#include "render/backend.h"

#include <string>
#include <vector>

namespace gnomon::render {

/// A picture of depths, and the path of its file.
struct NamedDepths {
    std::string path;
    FloatPicture depths;
};

/// Returns each map of `plan` as a picture. `backend` must have drawn the plan just before. The file name of a map
/// contains its slice and face.
std::vector<NamedDepths> shadowMaps(const plan::FramePlan& plan, Backend& backend);

} // namespace gnomon::render
