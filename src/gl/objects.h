// GL objects as move-only values: each owns one name and deletes it.
#pragma once

#include "gl/api.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::gl {

/// One GL name with the function that deletes it. The context must outlive it.
class Object {
public:
    using Delete = void(APIENTRYP)(GLsizei, const GLuint*);

    Object() = default;

    Object(GLuint id, Delete release) : id_(id), release_(release) {}

    ~Object() { reset(); }

    Object(Object&& other) noexcept : id_(std::exchange(other.id_, 0)), release_(other.release_) {}

    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            id_ = std::exchange(other.id_, 0);
            release_ = other.release_;
        }
        return *this;
    }

    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    /// 0 if there is none.
    GLuint id() const { return id_; }

private:
    void reset() {
        if (id_ != 0) release_(1, &id_);
        id_ = 0;
    }

    GLuint id_ = 0;
    Delete release_ = nullptr;
};

/// A buffer of fixed size whose content is written by `write`.
class Buffer {
public:
    Buffer() = default;
    Buffer(const Api& api, std::size_t bytes);

    void write(std::size_t offset, std::span<const std::byte> bytes) const;

    /// Replaces `bytes` bytes by those of the buffer `source`; the GPU does so in the order of the commands.
    void copy(std::size_t offset, GLuint source, std::size_t sourceOffset, std::size_t bytes) const;

    GLuint id() const { return object_.id(); }

    std::size_t size() const { return bytes_; }

private:
    const Api* api_ = nullptr;
    Object object_;
    std::size_t bytes_ = 0;
};

/// A 2D texture of fixed size and format with one level, sampled without filtering and clamped to its edge.
class Texture {
public:
    Texture() = default;
    Texture(const Api& api, GLenum internalFormat, int width, int height);

    /// One of GL_BGRA in GL_UNSIGNED_INT_8_8_8_8_REV, stored in that order, which is that of windows: what
    /// PictureFill draws fast. Leaves texture unit 0 of the context
    /// without a texture.
    static Texture ofWindowPictures(const Api& api, int width, int height);

    GLuint id() const { return object_.id(); }

    int width() const { return width_; }

    int height() const { return height_; }

    /// All texels, bottom row first; `out` must have width * height * bytes of a texel in `format` and `type`.
    void read(GLenum format, GLenum type, std::span<std::byte> out) const;

    /// How both smaller and larger ones are made of it: GL_NEAREST, which it begins with, or GL_LINEAR.
    void setFilter(GLint filter) const;

    /// Replaces all texels.
    void write(GLenum format, GLenum type, std::span<const std::byte> texels) const;

private:
    Texture(const Api& api, int width, int height);

    const Api* api_ = nullptr;
    Object object_;
    int width_ = 0;
    int height_ = 0;
};

/// A framebuffer over textures; a colour texture may be missing.
class Framebuffer {
public:
    Framebuffer() = default;
    /// Throws Error if the combination is not complete.
    Framebuffer(const Api& api, std::span<const Texture* const> colors, const Texture& depth);

    GLuint id() const { return object_.id(); }

private:
    Object object_;
};

/// An integer (`isInteger`) or normalised attribute of a vertex.
struct Attribute {
    GLuint location = 0;
    GLint components = 0;
    GLenum type = 0;
    bool isInteger = false;
    GLuint offset = 0; // within a vertex of its stream
    GLuint stream = 0;
};

/// Vertices that follow one another from a byte of a buffer on.
struct VertexStream {
    std::size_t offset = 0;
    GLsizei vertexBytes = 0;
};

/// Vertices and indices out of one buffer.
class VertexArray {
public:
    VertexArray() = default;
    VertexArray(
        const Api& api,
        const Buffer& buffer,
        std::span<const VertexStream> streams,
        std::span<const Attribute> attributes);
    /// No vertices: for passes whose vertex shader makes its own.
    explicit VertexArray(const Api& api);

    GLuint id() const { return object_.id(); }

private:
    Object object_;
};

} // namespace gnomon::gl
