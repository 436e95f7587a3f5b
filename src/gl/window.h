// Opens a window with an OpenGL 4.5 core context through GLFW.
#pragma once

#include "core/error.h"
#include "gl/context.h"

#include <memory>
#include <string>

struct GLFWwindow;

namespace gnomon::gl {

/// The error that no display is available for a window.
class NoDisplay : public Error {
public:
    using Error::Error;
};

/// A window and its OpenGL context, which is current on the thread that created it. A process can have only one window
/// at a time, because GLFW's state is global.
class Window {
public:
    /// Opens a window. `width` and `height` are the size of the framebuffer in pixels if the screen has no scale
    /// factor. Throws NoDisplay if there is no display, and gnomon::Error with GLFW's reason if there is no OpenGL 4.5.
    Window(const std::string& title, int width, int height);

    /// Returns the handle for GLFW functions.
    GLFWwindow* handle() const;

    const Context& context() const { return *context_; }

private:
    class Glfw;

    Glfw* glfw_ = nullptr; // owned by the context
    std::unique_ptr<Context> context_;
};

} // namespace gnomon::gl
