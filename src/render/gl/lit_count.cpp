#include "render/gl/lit_count.h"

namespace gnomon::render {

LitCount::LitCount(const gl::Api& api, const gl::ShaderLibrary& shaders)
    : api_(&api), program_(api, shaders, "image/fullscreen.vert", "image/lit_count.frag"), vertexless_(api) {
    GLuint name = 0;
    api.createFramebuffers(1, &name);
    framebuffer_ = {name, api.deleteFramebuffers};
    api.createQueries(GL_SAMPLES_PASSED, 1, &name);
    query_ = {name, api.deleteQueries};
}

void LitCount::begin(const gl::Texture& image) {
    const gl::Api& gl = *api_;
    gl.namedFramebufferParameteri(framebuffer_.id(), GL_FRAMEBUFFER_DEFAULT_WIDTH, image.width());
    gl.namedFramebufferParameteri(framebuffer_.id(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, image.height());
    gl.bindFramebuffer(GL_FRAMEBUFFER, framebuffer_.id());
    gl.viewport(0, 0, image.width(), image.height());
    gl.disable(GL_DEPTH_TEST);
    gl.useProgram(program_.id());
    gl.bindTextureUnit(0, image.id());
    gl.bindVertexArray(vertexless_.id());
    gl.beginQuery(GL_SAMPLES_PASSED, query_.id());
    gl.drawArrays(GL_TRIANGLES, 0, 3);
    gl.endQuery(GL_SAMPLES_PASSED);
}

std::uint64_t LitCount::finished() const {
    GLuint64 count = 0;
    api_->getQueryObjectui64v(query_.id(), GL_QUERY_RESULT, &count);
    return count;
}

bool LitCount::isDone() const {
    GLint isKnown = GL_FALSE;
    api_->getQueryObjectiv(query_.id(), GL_QUERY_RESULT_AVAILABLE, &isKnown);
    return isKnown != GL_FALSE;
}

std::uint64_t LitCount::of(const gl::Texture& image) {
    begin(image);
    return finished();
}

std::optional<std::uint64_t> LitCount::nowAndThen(const gl::Texture& image, plan::Shading shading) {
    constexpr int kImagesBetween = 16;
    if (!isCounting_ && uncountedImages_++ % kImagesBetween == 0) {
        begin(image);
        isCounting_ = true;
        counted_ = shading;
    }
    if (!isCounting_ || !isDone()) return std::nullopt;
    isCounting_ = false;
    if (counted_ != shading) return std::nullopt;
    return finished();
}

} // namespace gnomon::render
