// Fills a window with a picture.
#pragma once

#include "gl/objects.h"
#include "gl/program.h"

namespace gnomon::gl {

/// A program that draws a picture over the whole viewport.
///
/// Mesa's software OpenGL has a short cut for pictures in a window's own order of bytes, with one filter for larger and
/// smaller ones, a shader that does nothing else, and nothing that is mixed. It takes a third of the time there, and
/// goes wrong where the shader multiplies by a colour, as Dear ImGui's does.
class PictureFill {
public:
    PictureFill() = default;
    /// Throws Error if the shaders of `library` cannot be compiled.
    PictureFill(const Api& api, const ShaderLibrary& library);

    /// Draws all of a texture whose first row is the upper one into the framebuffer that is bound, in place of what it
    /// has; leaves tests, culling and mixing switched off.
    void draw(GLuint texture) const;

private:
    const Api* api_ = nullptr;
    Program program_;
    VertexArray noVertices_;
};

} // namespace gnomon::gl
