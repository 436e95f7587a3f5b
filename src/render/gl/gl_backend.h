// The backend that draws frames with OpenGL.
#pragma once

#include "core/units.h"
#include "gl/context.h"
#include "gl/shader_library.h"
#include "render/backend.h"

#include <memory>

namespace gnomon::render {

/// Tells how often the program waits until OpenGL has finished its work.
enum class GlSubmission {
    WaitsForEachPass,  // for Mesa's software renderers, whose clocks are wrong and whose queued work uses memory
    WaitsForEachFrame, // for a GPU without a window: measured times belong to the current frame
    Queues,            // for a GPU with a window: measured times belong to the last finished frame
};

/// Creates a backend with its own OpenGL context on `platform`. The memory of image, shadow maps and geometry stays
/// below `gpuMemory`. If `warn` is given, it is called for each GPU that cannot be used. Throws Error if no context can
/// be created.
std::unique_ptr<Backend> makeGlBackend(
    gl::Platform platform,
    const gl::ShaderLibrary& shaders,
    Bytes gpuMemory,
    const std::function<void(const std::string&)>& warn = {});

/// Creates a backend that draws in the OpenGL context of a window. The context must outlive the backend and be current
/// at every call.
std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory);

/// Creates a backend that draws in the OpenGL context of a window. `submission` tells when the backend waits for
/// OpenGL.
std::unique_ptr<Backend> makeWindowBackend(
    const gl::Context& context, const gl::ShaderLibrary& shaders, Bytes gpuMemory, GlSubmission submission);

} // namespace gnomon::render
