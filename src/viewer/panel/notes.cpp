#include "viewer/panel/notes.h"

#include <algorithm>
#include <cmath>

namespace gnomon::viewer {

float letterHeight() {
    return ImGui::GetFontSize();
}

bool beginNote(const char* name, const ImVec2& at, const ImVec2& pivot) {
    ImGui::SetNextWindowPos(at, ImGuiCond_Always, pivot);
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing |
                                        ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
    return ImGui::Begin(name, nullptr, kFlags);
}

void drawLine(const std::string& text, ImU32 color) {
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

ImVec2 onScreen(const glm::dvec2& pixel) {
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    return {
        static_cast<float>(pixel.x / static_cast<double>(scale.x)),
        static_cast<float>(pixel.y / static_cast<double>(scale.y))};
}

PictureFrame windowFrame(const Camera& camera) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
    return {camera, static_cast<int>(screen.x * scale.x), static_cast<int>(screen.y * scale.y)};
}

void drawSegments(std::span<const PixelSegment> segments, ImU32 color, float thickness) {
    // Max distance on the screen, in pixels, up to which a segment is drawn. A segment that starts near the plane of
    // the eye can end farther away, where floats cannot represent the coordinates.
    constexpr double kFar = 1e5;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (const PixelSegment& segment : segments) {
        glm::dvec2 a = segment[0];
        glm::dvec2 b = segment[1];
        if (std::max(std::abs(a.x), std::abs(a.y)) > kFar) a = glm::mix(b, a, kFar / glm::length(a - b));
        if (std::max(std::abs(b.x), std::abs(b.y)) > kFar) b = glm::mix(a, b, kFar / glm::length(a - b));
        draw.AddLine(onScreen(a), onScreen(b), color, thickness);
    }
}

} // namespace gnomon::viewer
