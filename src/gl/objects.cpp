#include "gl/objects.h"

#include "core/check.h"
#include "core/error.h"

#include <array>

namespace gnomon::gl {

namespace {

using Create = void(APIENTRYP)(GLsizei, GLuint*);

Object make(Create create, Object::Delete release) {
    GLuint id = 0;
    create(1, &id);
    return {id, release};
}

} // namespace

Buffer::Buffer(const Api& api, std::size_t bytes)
    : api_(&api), object_(make(api.createBuffers, api.deleteBuffers)), bytes_(bytes) {
    // The storage of the buffer is not immutable. NVIDIA's driver moves an immutable buffer at its first draw, at a
    // cost of 0.8 ms per megabyte.
    api.namedBufferData(id(), static_cast<GLsizeiptr>(bytes), nullptr, GL_STATIC_DRAW);
}

void Buffer::write(std::size_t offset, std::span<const std::byte> bytes) const {
    GNOMON_CHECK_OP(offset + bytes.size(), <=, bytes_);
    api_->namedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes.size()), bytes.data());
}

void Buffer::copy(std::size_t offset, GLuint source, std::size_t sourceOffset, std::size_t bytes) const {
    GNOMON_CHECK_OP(offset + bytes, <=, bytes_);
    api_->copyNamedBufferSubData(
        source,
        id(),
        static_cast<GLintptr>(sourceOffset),
        static_cast<GLintptr>(offset),
        static_cast<GLsizeiptr>(bytes));
}

Texture::Texture(const Api& api, GLenum internalFormat, int width, int height) : Texture(api, width, height) {
    api.textureStorage2D(id(), 1, internalFormat, width, height);
}

Texture Texture::ofWindowPictures(const Api& api, int width, int height) {
    Texture texture(api, width, height);
    // The internal format is unsized, because only then the driver preserves the byte order of the written pixels.
    api.activeTexture(GL_TEXTURE0);
    api.bindTexture(GL_TEXTURE_2D, texture.id());
    api.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_BGRA, GL_UNSIGNED_INT_8_8_8_8_REV, nullptr);
    api.bindTexture(GL_TEXTURE_2D, 0);
    return texture;
}

Texture::Texture(const Api& api, int width, int height) : api_(&api), width_(width), height_(height) {
    GLuint name = 0;
    api.createTextures(GL_TEXTURE_2D, 1, &name);
    object_ = {name, api.deleteTextures};
    setFilter(GL_NEAREST);
    api.textureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    api.textureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void Texture::setFilter(GLint filter) const {
    api_->textureParameteri(id(), GL_TEXTURE_MIN_FILTER, filter);
    api_->textureParameteri(id(), GL_TEXTURE_MAG_FILTER, filter);
}

void Texture::read(GLenum format, GLenum type, std::span<std::byte> out) const {
    api_->getTextureImage(id(), 0, format, type, static_cast<GLsizei>(out.size()), out.data());
}

void Texture::write(GLenum format, GLenum type, std::span<const std::byte> texels) const {
    api_->textureSubImage2D(id(), 0, 0, 0, width_, height_, format, type, texels.data());
}

Framebuffer::Framebuffer(const Api& api, std::span<const Texture* const> colors, const Texture& depth)
    : object_(make(api.createFramebuffers, api.deleteFramebuffers)) {
    std::vector<GLenum> targets;
    for (const Texture* color : colors) {
        const auto attachment = static_cast<GLenum>(GL_COLOR_ATTACHMENT0 + targets.size());
        api.namedFramebufferTexture(id(), attachment, color->id(), 0);
        targets.push_back(attachment);
    }
    api.namedFramebufferTexture(id(), GL_DEPTH_ATTACHMENT, depth.id(), 0);
    api.namedFramebufferDrawBuffers(id(), static_cast<GLsizei>(targets.size()), targets.data());
    if (api.checkNamedFramebufferStatus(id(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        throw Error("OpenGL", "the framebuffer is incomplete");
}

VertexArray::VertexArray(
    const Api& api, const Buffer& buffer, std::span<const VertexStream> streams, std::span<const Attribute> attributes)
    : VertexArray(api) {
    for (std::size_t s = 0; s < streams.size(); ++s)
        api.vertexArrayVertexBuffer(
            id(),
            static_cast<GLuint>(s),
            buffer.id(),
            static_cast<GLintptr>(streams[s].offset),
            streams[s].vertexBytes);
    api.vertexArrayElementBuffer(id(), buffer.id());
    for (const Attribute& a : attributes) {
        api.enableVertexArrayAttrib(id(), a.location);
        api.vertexArrayAttribBinding(id(), a.location, a.stream);
        if (a.isInteger)
            api.vertexArrayAttribIFormat(id(), a.location, a.components, a.type, a.offset);
        else
            api.vertexArrayAttribFormat(id(), a.location, a.components, a.type, GL_TRUE, a.offset);
    }
}

VertexArray::VertexArray(const Api& api) : object_(make(api.createVertexArrays, api.deleteVertexArrays)) {}

} // namespace gnomon::gl
