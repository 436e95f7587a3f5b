// Counts the lit pixels of an OpenGL image on the GPU.
#pragma once

#include "gl/objects.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "plan/shading_settings.h"

#include <cstdint>
#include <optional>

namespace gnomon::render {

/// Counts the lit pixels of an image with an occlusion query. The shader of the image has marked these pixels.
class LitCount {
public:
    LitCount(const gl::Api& api, const gl::ShaderLibrary& shaders);

    /// Returns the number of lit pixels of `image`, and waits for the GPU. The draw calls of the image must have been
    /// issued.
    std::uint64_t of(const gl::Texture& image);

    /// Counts the lit pixels of every few images without waiting for the GPU. The call for a later image returns the
    /// count. Returns nullopt if no new count is available, or if the counted image had other `shading` than `image`.
    std::optional<std::uint64_t> nowAndThen(const gl::Texture& image, plan::Shading shading);

private:
    void begin(const gl::Texture& image);
    std::uint64_t finished() const;
    bool isDone() const;

    const gl::Api* api_;
    gl::Program program_;
    gl::VertexArray vertexless_;
    gl::Object framebuffer_; // a framebuffer without textures
    gl::Object query_;
    bool isCounting_ = false; // true: a count has begun and has not been returned
    plan::Shading counted_{}; // shading of the counted image
    int uncountedImages_ = 0; // number of images since the last count began
};

} // namespace gnomon::render
