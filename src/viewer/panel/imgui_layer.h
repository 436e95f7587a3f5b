// Dear ImGui over a window: its context, its look and its frames.
#pragma once

struct GLFWwindow;

namespace gnomon::viewer {

/// Dear ImGui for one window, whose context must be current. Its callbacks hand on to those set before.
class ImGuiLayer {
public:
    explicit ImGuiLayer(GLFWwindow* window);
    ~ImGuiLayer();
    ImGuiLayer(const ImGuiLayer&) = delete;
    ImGuiLayer& operator=(const ImGuiLayer&) = delete;
    ImGuiLayer(ImGuiLayer&&) = delete;
    ImGuiLayer& operator=(ImGuiLayer&&) = delete;

    /// Fits fonts and distances to the screen's scale.
    void rescale();

    /// Between these two everything is described.
    void beginFrame();
    /// Draws what was described into the current framebuffer.
    void endFrame();

    bool wantsMouse() const;
    bool wantsKeys() const;

private:
    GLFWwindow* window_;
    bool hasFonts_ = false;
};

} // namespace gnomon::viewer
