// The executor that draws with OpenGL.
#pragma once

#include "core/units.h"
#include "executor/executor.h"
#include "gl/context.h"
#include "gl/shader_library.h"

#include <memory>

namespace gnomon::executor {

/// When the program waits for what it asked of OpenGL.
enum class GlSubmission {
    WaitsForEachPass,  // Mesa's software renderers: their clocks are wrong, and what they queue takes memory
    WaitsForEachFrame, // a GPU without a window: each frame has its own times
    Queues,            // a GPU with a window: times are those of the last frame that is known to be done
};

/// Draws with `platform`'s context; image, maps and geometry stay under `gpuMemory`. Tells `warn`, if given, which GPUs
/// cannot be used. Throws Error if there is no context.
std::unique_ptr<Executor> makeGlExecutor(
    gl::Platform platform,
    const gl::ShaderLibrary& shaders,
    Bytes gpuMemory,
    const std::function<void(const std::string&)>& warn = {});

/// Makes an executor that draws in a window's context. The context must outlive it and be current at every call.
std::unique_ptr<Executor> makeWindowExecutor(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

/// The same, waiting as `submission` says whatever the context is.
std::unique_ptr<Executor> makeWindowExecutor(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory, GlSubmission submission);

} // namespace gnomon::executor
