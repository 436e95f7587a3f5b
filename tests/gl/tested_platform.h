// Where the tests of OpenGL draw: in memory, or on a GPU if whoever runs them says so.
#pragma once

#include "gl/context.h"

#include <cstdlib>
#include <string_view>

namespace gnomon::gl {

/// OSMesa; EGL, and so a GPU where there is one, with GNOMON_TEST_GL=egl.
inline Platform testedPlatform() {
    const char* const wanted = std::getenv("GNOMON_TEST_GL");
    return wanted != nullptr && std::string_view(wanted) == "egl" ? Platform::Egl : Platform::Osmesa;
}

} // namespace gnomon::gl
