#include "viewer/panel/imgui_layer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>

#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_opengl3.h>
#include <imgui/imgui.h>

namespace gnomon::viewer {

namespace {

constexpr float kFontPixels = 13; // native size of the built-in font

} // namespace

ImGuiLayer::ImGuiLayer(GLFWwindow* window) : window_(window) {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // do not write a file
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 450 core");
    rescale();
}

ImGuiLayer::~ImGuiLayer() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void ImGuiLayer::rescale() {
    float x = 1;
    float y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    const float scale = std::clamp(std::max(x, y), 0.5F, 8.0F);
    ImGuiStyle style;
    ImGui::StyleColorsDark(&style);
    style.WindowRounding = 4;
    style.WindowBorderSize = 0;
    style.Colors[ImGuiCol_WindowBg].w = 0.82F;
    style.ScaleAllSizes(scale);
    ImGui::GetStyle() = style;
    ImGuiIO& io = ImGui::GetIO();
    io.Fonts->Clear();
    ImFontConfig font;
    font.SizePixels = std::round(kFontPixels * scale);
    io.Fonts->AddFontDefault(&font);
    if (hasFonts_) {
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
}

void ImGuiLayer::beginFrame() {
    ImGui_ImplOpenGL3_NewFrame();
    hasFonts_ = true;
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
}

void ImGuiLayer::endFrame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool ImGuiLayer::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool ImGuiLayer::wantsKeys() const {
    return ImGui::GetIO().WantTextInput;
}

} // namespace gnomon::viewer
