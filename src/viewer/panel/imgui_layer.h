// Dear ImGui for a window: its context, style and frames.
#pragma once

struct GLFWwindow;

namespace gnomon::viewer {

/// Dear ImGui for one window, whose context must be current. Its callbacks forward events to the previously installed
/// callbacks.
class ImGuiLayer {
public:
    explicit ImGuiLayer(GLFWwindow* window);
    ~ImGuiLayer();
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;
    ImGuiLayer(ImGuiLayer&&) = delete;
    ImGuiLayer& operator=(ImGuiLayer&&) = delete;

    /// Adapts fonts and distances to the scale of the screen.
    void rescale();

    /// Begins a frame. All elements must be described between beginFrame and endFrame.
    void beginFrame();
    /// Draws the described elements into the current framebuffer.
    void endFrame();

    bool wantsMouse() const;
    bool wantsKeys() const;

private:
    GLFWwindow* window_;
    bool hasFonts_ = false;
};

} // namespace gnomon::viewer
