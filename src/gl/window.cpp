#include "gl/window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gnomon::gl {

namespace {

/// Returns the reason that GLFW gives for its last failure.
std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text == nullptr ? "no reason given" : text;
}

} // namespace

/// Initialises GLFW and owns its only window.
class Window::Glfw final : public NativeContext {
public:
    Glfw(const std::string& title, int width, int height) {
        if (glfwInit() != GLFW_TRUE) throw NoDisplay("no display to open a window on (" + lastError() + ")");
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        // The window needs no depth and stencil bits. Drawing goes into framebuffer objects, and the window only
        // receives finished images.
        glfwWindowHint(GLFW_DEPTH_BITS, 0);
        glfwWindowHint(GLFW_STENCIL_BITS, 0);
        window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
        if (window_ == nullptr) {
            const std::string reason = lastError();
            glfwTerminate();
            throw Error("window", "no OpenGL context (" + reason + ")", "OpenGL 4.5 core", "none");
        }
        glfwMakeContextCurrent(window_);
        glfwSwapInterval(1);
    }

    ~Glfw() override {
        glfwDestroyWindow(window_);
        glfwTerminate();
    }

    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
    Glfw(Glfw&&) = delete;
    Glfw& operator=(Glfw&&) = delete;

    FunctionSource functionSource() const override { return glfwGetProcAddress; }

    GLFWwindow* window() const { return window_; }

private:
    GLFWwindow* window_ = nullptr;
};

Window::Window(const std::string& title, int width, int height) {
    auto glfw = std::make_unique<Glfw>(title, width, height);
    glfw_ = glfw.get();
    context_ = std::make_unique<Context>(std::move(glfw));
}

GLFWwindow* Window::handle() const {
    return glfw_->window();
}

} // namespace gnomon::gl
