// The OpenGL backend.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/shader_library.h"
#include "render/backend.h"

#include <memory>

namespace gnomon::render {

/// The points at which the program waits for OpenGL.
enum class GlSubmission {
    WaitsForEachPass,  // Mesa's software renderers: their clocks are wrong, and queued work uses memory
    WaitsForEachFrame, // a GPU without a window: each frame has its own times
    Queues,            // a GPU with a window: times belong to the last frame that is finished
};

/// Makes a backend with its own context of `platform`. Image, maps and geometry stay below `gpuMemory`. Calls `warn`,
/// if given, for each GPU that cannot be used. Throws Error if there is no context.
std::unique_ptr<Backend> makeGlBackend(
    gl::Platform platform,
    const gl::ShaderLibrary& shaders,
    Bytes gpuMemory,
    const std::function<void(const std::string&)>& warn = {});

/// Makes an backend that draws in a window's context. The context must outlive it and be current at every call.
std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

/// The same, waiting as `submission` says whatever the context is.
std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory, GlSubmission submission);

} // namespace gnomon::render
