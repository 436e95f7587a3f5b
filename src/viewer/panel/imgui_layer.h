// Connects Dear ImGui to a window: its context, style and frames.
#pragma once

struct GLFWwindow;

namespace gnomon::viewer {

/// The Dear ImGui context of one window, whose OpenGL context must be current. Its callbacks also call the callbacks
/// that were installed before.
class ImGuiLayer {
public:
    explicit ImGuiLayer(GLFWwindow* window);
    ~ImGuiLayer();
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;
    ImGuiLayer(ImGuiLayer&&) = delete;
    ImGuiLayer& operator=(ImGuiLayer&&) = delete;

    /// Adapts fonts and distances of the user interface to the scale of the screen.
    void rescale();

    /// Begins a frame of Dear ImGui. All user interface elements must be submitted between beginFrame and endFrame.
    void beginFrame();
    /// Draws the submitted user interface elements into the current framebuffer.
    void endFrame();

    bool wantsMouse() const;
    bool wantsKeys() const;

private:
    GLFWwindow* window_;
    bool hasFonts_ = false;
};

} // namespace gnomon::viewer
