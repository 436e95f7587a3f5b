// A shader program that draws an image over a whole window.
#pragma once

#include "gl/objects.h"
#include "gl/program.h"

namespace gnomon::gl {

/// A shader program that draws an image over the whole viewport. Mesa's software OpenGL has a fast path for images in
/// the byte order of the window, which takes a third of the time. It requires the same filter for minification and
/// magnification, a shader that only samples the texture, and no blending. The fast path gives wrong results if the
/// shader multiplies by a colour, as the shader of Dear ImGui does.
class PictureFill {
public:
    PictureFill() = default;
    /// Compiles the shader program. Throws Error if the shaders of `library` cannot be compiled.
    PictureFill(const Api& api, const ShaderLibrary& library);

    /// Draws a texture, whose first row is the top row, over the whole bound framebuffer. Afterwards depth test,
    /// scissor test, culling and blending are disabled.
    void draw(GLuint texture) const;

private:
    const Api* api_ = nullptr;
    Program program_;
    VertexArray noVertices_;
};

} // namespace gnomon::gl
