// The shadow maps of a frame as pictures.
#pragma once

#include "render/backend.h"

#include <string>
#include <vector>

namespace gnomon::render {

/// A picture of depths, and the file that it is for.
struct NamedDepths {
    std::string path;
    FloatPicture depths;
};

/// Returns each map of `plan`, which `backend` has just drawn. The name of its file is made of its slice and face.
std::vector<NamedDepths> shadowMaps(const plan::FramePlan& plan, Backend& backend);

} // namespace gnomon::render
