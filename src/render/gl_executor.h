// The executor that draws with OpenGL.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/shader_library.h"
#include "render/executor.h"

#include <memory>

namespace gnomon::render {

/// Draws with `platform`'s context; geometry stays under `gpuMemory`. Throws Error if there is no context.
std::unique_ptr<Executor> makeGlExecutor(gl::Platform platform, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

} // namespace gnomon::render
