// Collects the keyboard and mouse events of a window since the last frame, from the callbacks of GLFW.
#pragma once

#include <glm/glm.hpp>

#include <set>
#include <string>
#include <vector>

struct GLFWwindow;

namespace gnomon::viewer {

/// A key press.
struct KeyPress {
    int key = 0; // key code of GLFW
    bool withShift = false;
};

/// A mouse drag since the last frame, in pixels of the framebuffer. x points to the right, and y points down.
struct Drag {
    int button = 0;    // button code of GLFW
    int modifiers = 0; // GLFW modifier bits at the start of the drag
    glm::dvec2 moved{0};
    bool hasBegun = false; // whether the drag started in this frame
};

/// A mouse click: the left button was released at the position where it was pressed.
struct Click {
    glm::dvec2 at{0}; // pixels of the framebuffer
    bool withShift = false;
    std::size_t pressesBefore = 0; // number of key presses before the click since the last frame
};

/// The keyboard and mouse events of one window. The object must outlive the callbacks of the window. It must be created
/// before Dear ImGui, whose callbacks forward events to it.
class Input {
public:
    explicit Input(GLFWwindow* window);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    Input(Input&&) = delete;
    Input& operator=(Input&&) = delete;

    /// Starts a new frame: forgets the key presses, drags and wheel notches of the last frame. Held keys remain held.
    void beginFrame();

    /// Returns true if any event arrived since `beginFrame`, including mouse movements.
    bool hasHappened() const { return hasHappened_; }

    const std::vector<KeyPress>& presses() const { return presses_; }

    /// Returns true if `key` is held, or was pressed since the last frame. A short tap therefore counts for one frame.
    bool isHeld(int key) const;

    bool isHeldControl() const;

    const std::vector<Drag>& drags() const { return drags_; }

    const std::vector<Click>& clicks() const { return clicks_; }

    double wheel() const { return wheel_; }

    /// Returns true if the left mouse button was clicked twice in a row at one position.
    bool hasDoubleClicked() const { return hasDoubleClicked_; }

    /// Returns the position of the mouse cursor in pixels of the framebuffer, from the upper left corner.
    glm::dvec2 cursor() const { return cursor_; }

    const std::vector<std::string>& dropped() const { return dropped_; }

    /// Returns true if the content scale (pixels per point) of the window changed since the last frame.
    bool hasNewScale() const { return hasNewScale_; }

    /// Sets whether the mouse is over an element of the panel that uses its clicks. Must be called before the events of
    /// the frame arrive.
    void setMouseTaken(bool isTaken) { isMouseTaken_ = isTaken; }

private:
    static Input& of(GLFWwindow* window);
    void onKey(int key, int action, int modifiers);
    void onButton(int button, int action, int modifiers);
    void onCursor(double x, double y);
    void onFocus(bool hasFocus);

    GLFWwindow* window_;
    bool hasHappened_ = false;
    bool hasNewScale_ = false;
    bool isMouseTaken_ = false;
    std::set<int> held_;
    std::set<int> tapped_;
    std::vector<KeyPress> presses_;
    int dragButton_ = -1;
    int dragModifiers_ = 0;
    bool hasDoubleClicked_ = false;
    double lastClick_ = -1; // time of the last click of the left button, in seconds
    glm::dvec2 lastClickAt_{0};
    std::vector<Drag> drags_;
    glm::dvec2 pressedAt_{0}; // start of the current drag
    std::vector<Click> clicks_;
    double wheel_ = 0;
    glm::dvec2 cursor_{0};
    std::vector<std::string> dropped_;
};

} // namespace gnomon::viewer
