// An OpenGL 4.5 core context: OSMesa in memory, EGL without a surface, or a window's.
#pragma once

#include "gl/api.h"
#include "gl/native_context.h"

#include <functional>
#include <memory>
#include <string>

namespace gnomon::gl {

/// Where a context comes from. `Egl` is the first GPU of EGL that can be used. If EGL knows no GPU, `Egl` is its
/// surfaceless platform.
enum class Platform { Osmesa, Egl };

/// A context, current on the thread that made it until it is destroyed or another is made there. Everything is drawn
/// into framebuffer objects; clip space is z in [0, 1] with the origin at the lower left.
class Context {
public:
    /// Tells `warn`, if given, in a line of each GPU that cannot be used. Throws gnomon::Error if the library, the
    /// context or a function is missing.
    explicit Context(Platform platform, const std::function<void(const std::string&)>& warn = {});

    /// The context that `native` is, current on this thread. Throws gnomon::Error if a function is missing.
    explicit Context(std::unique_ptr<NativeContext> native);

    const Api& api() const { return *api_; }

    /// Makes one without a window current again, if another was made after it.
    void makeCurrent() const { native_->makeCurrent(); }

    /// GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const { return renderer_; }

    /// True unless the renderer is one of Mesa's software ones.
    bool isHardware() const;

    /// The largest width or height of a texture.
    int maxTextureSize() const { return maxTextureSize_; }

    /// Throws gnomon::Error naming `where` if GL has recorded an error since the last call.
    void check(const char* where) const;

private:
    std::unique_ptr<NativeContext> native_;
    std::unique_ptr<Api> api_; // at a fixed address: GL objects keep a pointer to it
    std::string renderer_;
    int maxTextureSize_ = 0;
};

/// Makes a context current when it is destroyed. The last member of whoever owns objects of that context: their names
/// are those of other things in other contexts.
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

/// Whether EGL knows a device that is not software. Loads EGL, makes no context.
bool hasGpu();

} // namespace gnomon::gl
