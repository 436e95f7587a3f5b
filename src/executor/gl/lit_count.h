// How many pixels of an image the light reaches, counted where the image lies.
#pragma once

#include "gl/objects.h"
#include "gl/program.h"
#include "gl/shader_library.h"
#include "plan/look.h"

#include <cstdint>
#include <optional>

namespace gnomon::executor {

/// Counts the pixels that the image's shader marked as lit: what passes a test that all others fail.
class LitCount {
public:
    LitCount(const gl::Api& api, const gl::ShaderLibrary& shaders);

    /// Those of `image`, whose commands must have been issued. Waits until the GPU has done them.
    std::uint64_t of(const gl::Texture& image);

    /// The same, without waiting: one image now and then is counted, and its count given some frames later; nothing if
    /// that was not `shading`'s, with which `image` was drawn.
    std::optional<std::uint64_t> nowAndThen(const gl::Texture& image, plan::Shading shading);

private:
    void begin(const gl::Texture& image);
    std::uint64_t finished() const;
    bool isDone() const;

    const gl::Api* api_;
    gl::Program program_;
    gl::VertexArray vertexless_;
    gl::Object framebuffer_; // without textures
    gl::Object query_;
    bool isCounting_ = false; // what was begun is not given yet
    plan::Shading counted_{}; // what was begun was drawn with
    int uncountedImages_ = 0; // since one was begun
};

} // namespace gnomon::executor
