#include "gl/picture_fill.h"

namespace gnomon::gl {

PictureFill::PictureFill(const Api& api, const ShaderLibrary& library)
    : api_(&api), program_(api, library, "window/picture.vert", "window/picture.frag"), noVertices_(api) {}

void PictureFill::draw(GLuint texture) const {
    api_->disable(GL_BLEND);
    api_->disable(GL_CULL_FACE);
    api_->disable(GL_DEPTH_TEST);
    api_->disable(GL_SCISSOR_TEST);
    api_->useProgram(program_.id());
    api_->bindVertexArray(noVertices_.id());
    api_->bindSampler(0, 0);
    api_->bindTextureUnit(0, texture);
    api_->drawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

} // namespace gnomon::gl
