#include "viewer/input/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace gnomon::viewer {

Input& Input::of(GLFWwindow* window) {
    return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

Input::Input(GLFWwindow* window) : window_(window) {
    glfwSetWindowUserPointer(window, this);
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int /*scancode*/, int action, int modifiers) {
        of(w).onKey(key, action, modifiers);
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
        of(w).onButton(button, action, modifiers);
    });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).onCursor(x, y); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double /*x*/, double y) {
        Input& input = of(w);
        input.hasHappened_ = true;
        if (!input.isMouseTaken_) input.wheel_ += y;
    });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        Input& input = of(w);
        input.hasHappened_ = true;
        input.dropped_.insert(input.dropped_.end(), paths, paths + count);
    });
    glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int hasFocus) { of(w).onFocus(hasFocus == GLFW_TRUE); });
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w).hasHappened_ = true; });
    glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w).hasHappened_ = true; });
    glfwSetWindowIconifyCallback(window, [](GLFWwindow* w, int) { of(w).hasHappened_ = true; });
    glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) {
        of(w).hasHappened_ = true;
        of(w).hasNewScale_ = true;
    });
}

Input::~Input() {
    glfwSetWindowUserPointer(window_, nullptr);
}

void Input::beginFrame() {
    hasHappened_ = false;
    hasNewScale_ = false;
    presses_.clear();
    tapped_.clear();
    drags_.clear();
    clicks_.clear();
    dropped_.clear();
    wheel_ = 0;
    hasDoubleClicked_ = false;
}

bool Input::isHeld(int key) const {
    return held_.count(key) > 0 || tapped_.count(key) > 0;
}

bool Input::isHeldControl() const {
    return isHeld(GLFW_KEY_LEFT_CONTROL) || isHeld(GLFW_KEY_RIGHT_CONTROL);
}

void Input::onKey(int key, int action, int modifiers) {
    hasHappened_ = true;
    if (action == GLFW_RELEASE) {
        held_.erase(key);
        return;
    }
    held_.insert(key);
    tapped_.insert(key);
    if (action == GLFW_PRESS) presses_.push_back({key, (modifiers & GLFW_MOD_SHIFT) != 0});
}

void Input::onButton(int button, int action, int modifiers) {
    // Max distance in pixels between the press and the release of a click, and between both clicks of a double click.
    constexpr double kOnePlace = 5;
    hasHappened_ = true;
    if (action == GLFW_RELEASE) {
        if (button != dragButton_) return;
        dragButton_ = -1;
        if (button == GLFW_MOUSE_BUTTON_LEFT && glm::distance(cursor_, pressedAt_) < kOnePlace)
            clicks_.push_back({pressedAt_, (dragModifiers_ & GLFW_MOD_SHIFT) != 0, presses_.size()});
        return;
    }
    if (isMouseTaken_ || dragButton_ != -1) return;
    dragButton_ = button;
    dragModifiers_ = modifiers;
    pressedAt_ = cursor_;
    drags_.push_back({button, modifiers, glm::dvec2(0), true});
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    constexpr double kBetweenClicks = 0.35; // seconds: max time between both clicks of a double click
    const double time = glfwGetTime();
    hasDoubleClicked_ = time - lastClick_ < kBetweenClicks && glm::distance(cursor_, lastClickAt_) < kOnePlace;
    lastClick_ = hasDoubleClicked_ ? -1 : time; // a third click starts a new double click
    lastClickAt_ = cursor_;
}

void Input::onCursor(double x, double y) {
    hasHappened_ = true;
    // Window coordinates of GLFW differ from pixels if the window system scales the screen.
    int width = 0;
    int height = 0;
    int pixelsWide = 0;
    int pixelsHigh = 0;
    glfwGetWindowSize(window_, &width, &height);
    glfwGetFramebufferSize(window_, &pixelsWide, &pixelsHigh);
    const glm::dvec2 scale(
        width > 0 ? static_cast<double>(pixelsWide) / width : 1.0,
        height > 0 ? static_cast<double>(pixelsHigh) / height : 1.0);
    const glm::dvec2 now = glm::dvec2(x, y) * scale;
    const glm::dvec2 moved = now - cursor_;
    cursor_ = now;
    if (dragButton_ == -1) return;
    if (drags_.empty() || drags_.back().button != dragButton_)
        drags_.push_back({dragButton_, dragModifiers_, glm::dvec2(0), false});
    drags_.back().moved += moved;
}

void Input::onFocus(bool hasFocus) {
    hasHappened_ = true;
    if (hasFocus) return;
    // The window that has the focus now receives the releases of the held keys, so this window would never see them.
    held_.clear();
    dragButton_ = -1;
}

} // namespace gnomon::viewer
