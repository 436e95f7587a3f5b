// The software backend: rasterises the visible triangles on the CPU, and then shades the visible pixels.
#pragma once

#include "render/backend.h"

#include <memory>

namespace gnomon::render {

/// Creates a backend that draws the same frames as the OpenGL backend, on all CPU cores. The picture does not depend on
/// the number of cores.
std::unique_ptr<Backend> makeSoftwareBackend();

} // namespace gnomon::render
