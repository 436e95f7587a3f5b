// OpenGL objects as move-only values. Each value owns one OpenGL object and deletes it.
#pragma once

#include "gl/api.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::gl {

/// Owns the name of an OpenGL object and deletes the object. The context must outlive it.
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

    /// Returns the name of the OpenGL object, or 0 if there is none.
    GLuint id() const { return id_; }

private:
    void reset() {
        if (id_ != 0) release_(1, &id_);
        id_ = 0;
    }

    GLuint id_ = 0;
    Delete release_ = nullptr;
};

/// An OpenGL buffer of fixed size, whose content `write` sets.
class Buffer {
public:
    Buffer() = default;
    Buffer(const Api& api, std::size_t bytes);

    void write(std::size_t offset, std::span<const std::byte> bytes) const;

    /// Copies `bytes` bytes from the buffer `source` into this buffer, on the GPU and in the order of the OpenGL
    /// commands.
    void copy(std::size_t offset, GLuint source, std::size_t sourceOffset, std::size_t bytes) const;

    GLuint id() const { return object_.id(); }

    std::size_t size() const { return bytes_; }

private:
    const Api* api_ = nullptr;
    Object object_;
    std::size_t bytes_ = 0;
};

/// A 2D texture with fixed size, fixed format and one mipmap level. By default, sampling uses no filter and clamps to
/// the edge.
class Texture {
public:
    Texture() = default;
    Texture(const Api& api, GLenum internalFormat, int width, int height);

    /// Creates a texture for PictureFill in the byte order of windows: GL_BGRA with GL_UNSIGNED_INT_8_8_8_8_REV.
    /// PictureFill draws this order fastest. Unbinds the texture of unit 0 of the context.
    static Texture ofWindowPictures(const Api& api, int width, int height);

    GLuint id() const { return object_.id(); }

    int width() const { return width_; }

    int height() const { return height_; }

    /// Reads all texels into `out`, bottom row first. `out` has width * height texels in `format` and `type`.
    void read(GLenum format, GLenum type, std::span<std::byte> out) const;

    /// Sets the filter of the texture for minification and magnification: GL_NEAREST, which is the default, or
    /// GL_LINEAR.
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

/// An OpenGL framebuffer with textures as attachments. The list of colour textures can be empty.
class Framebuffer {
public:
    Framebuffer() = default;
    /// Creates a framebuffer with the given textures as attachments. Throws Error if it is not complete.
    Framebuffer(const Api& api, std::span<const Texture* const> colors, const Texture& depth);

    GLuint id() const { return object_.id(); }

private:
    Object object_;
};

/// The format of a vertex attribute. Its components are integers (`isInteger`) or normalised numbers.
struct Attribute {
    GLuint location = 0;
    GLint components = 0;
    GLenum type = 0;
    bool isInteger = false;
    GLuint offset = 0; // in bytes from the start of the vertex in its stream
    GLuint stream = 0;
};

/// A sequence of vertices in a buffer, starting at a byte offset, with its attributes.
struct VertexStream {
    std::size_t offset = 0;
    GLsizei vertexBytes = 0;
};

/// An OpenGL vertex array, whose vertices and indices are in one buffer.
class VertexArray {
public:
    VertexArray() = default;
    VertexArray(
        const Api& api,
        const Buffer& buffer,
        std::span<const VertexStream> streams,
        std::span<const Attribute> attributes);
    /// Creates a vertex array without vertices, for passes whose vertex shader generates the vertices.
    explicit VertexArray(const Api& api);

    GLuint id() const { return object_.id(); }

private:
    Object object_;
};

} // namespace gnomon::gl
