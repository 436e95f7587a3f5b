// The software backend: a rasteriser for visible triangles, and shading of the visible pixels.
#pragma once

#include "render/backend.h"

#include <memory>

namespace gnomon::render {

/// Makes a backend that draws the same frames as the GL backend on all CPU cores. The picture does not depend on the
/// number of cores.
std::unique_ptr<Backend> makeSoftwareBackend();

} // namespace gnomon::render
