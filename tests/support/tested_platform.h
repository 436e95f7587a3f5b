// The platform for OpenGL tests: OSMesa, or a GPU on request.
#pragma once

#include "gl/context.h"

#include <cstdlib>
#include <string_view>

namespace gnomon::gl {

/// Returns OSMesa, or EGL (a GPU if there is one) if GNOMON_TEST_GL=egl.
inline Platform testedPlatform() {
    const char* const wanted = std::getenv("GNOMON_TEST_GL");
    return wanted != nullptr && std::string_view(wanted) == "egl" ? Platform::Egl : Platform::Osmesa;
}

} // namespace gnomon::gl
