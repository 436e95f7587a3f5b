// The executor that draws with OpenGL.
#pragma once

#include "core/units.h"
#include "executor/executor.h"
#include "gl/context.h"
#include "gl/objects.h"
#include "gl/shader_library.h"

#include <memory>

namespace gnomon::executor {

/// Draws with `platform`'s context; image, maps and geometry stay under `gpuMemory`. Throws Error if there is no
/// context.
std::unique_ptr<Executor> makeGlExecutor(gl::Platform platform, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

/// An executor whose picture can be shown where it was drawn, without reading it back.
class TextureExecutor : public Executor {
public:
    /// The colours of the last frame, bottom row first.
    virtual const gl::Texture& texture() const = 0;
};

/// Draws in a window's context, which must outlive it and be current whenever it is called.
std::unique_ptr<TextureExecutor> makeWindowExecutor(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

} // namespace gnomon::executor
