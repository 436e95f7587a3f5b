// A window on the screen with an OpenGL 4.5 core context, through GLFW.
#pragma once

#include "core/error.h"
#include "gl/context.h"

#include <memory>
#include <string>

struct GLFWwindow;

namespace gnomon::gl {

/// There is no display to open a window on.
class NoDisplay : public Error {
public:
    using Error::Error;
};

/// A window and its context, current on the thread that made it. One at a time in a process: GLFW's state is global.
class Window {
public:
    /// `width` and `height` are those of the framebuffer where the screen has no scale of its own. Throws
    /// NoDisplay or gnomon::Error with GLFW's reason if there is no display or no OpenGL 4.5.
    Window(const std::string& title, int width, int height);

    /// For GLFW's own calls.
    GLFWwindow* handle() const;

    const Context& context() const { return *context_; }

private:
    class Glfw;

    Glfw* glfw_ = nullptr; // owned by the context
    std::unique_ptr<Context> context_;
};

} // namespace gnomon::gl
