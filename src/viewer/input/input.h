// What happened to the window since the last frame, gathered from GLFW's callbacks.
#pragma once

#include <glm/glm.hpp>

#include <set>
#include <string>
#include <vector>

struct GLFWwindow;

namespace gnomon::viewer {

/// A key that went down.
struct KeyPress {
    int key = 0; // GLFW's
    bool withShift = false;
};

/// A drag with the mouse since the last frame, in pixels of the framebuffer; x to the right, y down.
struct Drag {
    int button = 0;    // GLFW's
    int modifiers = 0; // GLFW's, as they were when it began
    glm::dvec2 moved{0};
    bool hasBegun = false; // this frame
};

/// A press of the left button that was let go where it was.
struct Click {
    glm::dvec2 at{0}; // pixels of the framebuffer
    bool withShift = false;
    std::size_t pressesBefore = 0; // keys that went down before it, since the last frame
};

/// The keys and the mouse of one window. It must outlive the window's callbacks; make it before Dear ImGui's, which
/// hand on to it.
class Input {
public:
    explicit Input(GLFWwindow* window);
    ~Input();
    Input(const Input&) = delete;
    Input& operator=(const Input&) = delete;
    Input(Input&&) = delete;
    Input& operator=(Input&&) = delete;

    /// Begins a new frame: forgets presses, drags and wheel of the last one; keys that are held stay held.
    void beginFrame();

    /// Whether anything happened since `beginFrame`, mere movements of the mouse included.
    bool hasHappened() const { return hasHappened_; }

    const std::vector<KeyPress>& presses() const { return presses_; }

    /// Whether `key` is held, or was pressed at all since the last frame: a tap counts for a frame.
    bool isHeld(int key) const;

    bool isHeldControl() const;

    const std::vector<Drag>& drags() const { return drags_; }

    const std::vector<Click>& clicks() const { return clicks_; }

    double wheel() const { return wheel_; }

    /// Whether the left button was clicked twice in a row, at one place.
    bool hasDoubleClicked() const { return hasDoubleClicked_; }

    /// Where the cursor is, pixels of the framebuffer from its upper left.
    glm::dvec2 cursor() const { return cursor_; }

    const std::vector<std::string>& dropped() const { return dropped_; }

    /// Whether the content scale has changed since the last frame.
    bool hasNewScale() const { return hasNewScale_; }

    /// Set before events are taken in: whether the mouse is over something that keeps its clicks for itself.
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
    double lastClick_ = -1; // seconds, of the left button
    glm::dvec2 lastClickAt_{0};
    std::vector<Drag> drags_;
    glm::dvec2 pressedAt_{0}; // where the drag at hand began
    std::vector<Click> clicks_;
    double wheel_ = 0;
    glm::dvec2 cursor_{0};
    std::vector<std::string> dropped_;
};

} // namespace gnomon::viewer
