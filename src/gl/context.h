// Creates OpenGL 4.5 core contexts: OSMesa in memory, EGL without a surface, or the context of a window.
#pragma once

#include "gl/api.h"
#include "gl/native_context.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::gl {

/// The library that creates an OpenGL context. `Egl` uses the first usable GPU of EGL. If EGL has no GPU, `Egl` uses
/// its surfaceless platform.
enum class Platform { Osmesa, Egl };

/// An OpenGL context. It is current on its thread until it is destroyed or another context is made there. All drawing
/// goes into framebuffer objects. Clip space has z in [0, 1] and its origin at the lower left.
class Context {
public:
    /// Creates a context. Calls `warn`, if given, with one line per GPU that cannot be used. Throws gnomon::Error if
    /// the library, the context or a function is missing.
    explicit Context(Platform platform, const std::function<void(const std::string&)>& warn = {});

    /// Wraps the context `native`, which is current on this thread. Throws gnomon::Error if an OpenGL function is
    /// missing.
    explicit Context(std::unique_ptr<NativeContext> native);

    const Api& api() const { return *api_; }

    /// Makes this OpenGL context current on its thread again, after another context was made there. Does nothing for
    /// the context of a window.
    void makeCurrent() const { native_->makeCurrent(); }

    /// Returns the OpenGL string GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const { return renderer_; }

    /// Returns true if the context draws on a GPU, that is, if it is none of Mesa's software renderers.
    bool isHardware() const;

    /// Returns the max width and height of a texture in texels.
    int maxTextureSize() const { return maxTextureSize_; }

    /// Throws gnomon::Error with the name `where` if OpenGL has recorded an error since the last call.
    void check(const char* where) const;

private:
    std::unique_ptr<NativeContext> native_;
    std::unique_ptr<Api> api_; // at a fixed address, because GL objects keep a pointer to it
    std::string renderer_;
    int maxTextureSize_ = 0;
};

/// Makes a context current when it is destroyed. A class with OpenGL objects declares this guard as its last member.
/// The guard is then destroyed first, so that the objects are deleted in their own context. In another context, the
/// same names could belong to other objects.
class CurrentAtDestruction {
public:
    explicit CurrentAtDestruction(const Context& context) : context_(&context) {}

    ~CurrentAtDestruction();
    CurrentAtDestruction(const CurrentAtDestruction&) = delete;
    CurrentAtDestruction& operator=(const CurrentAtDestruction&) = delete;
    CurrentAtDestruction(CurrentAtDestruction&&) = delete;
    CurrentAtDestruction& operator=(CurrentAtDestruction&&) = delete;

private:
    const Context* context_;
};

/// Returns true if EGL has a hardware device. Loads the EGL library but creates no context.
bool hasGpu();

} // namespace gnomon::gl
