// Counts the lit pixels of an image on the GPU.
#pragma once

#include "gl/objects.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "plan/shading_settings.h"

#include <cstdint>
#include <optional>

namespace gnomon::render {

/// A counter of the pixels that the image's shader marked as lit. It uses an occlusion query.
class LitCount {
public:
    LitCount(const gl::Api& api, const gl::ShaderLibrary& shaders);

    /// Returns the number of lit pixels of `image`. The draw commands of the image must have been issued. Waits for the
    /// GPU.
    std::uint64_t of(const gl::Texture& image);

    /// Counts the lit pixels of some images without waiting for the GPU. The count is returned in the call for a later
    /// image. Returns nullopt if no new count is available, or if the counted image had other `shading` than `image`.
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
