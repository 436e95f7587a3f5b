// What notes over the picture are made of: small windows at fixed places, their lines, and strokes on the picture.
#pragma once

#include "viewer/panel/wire_frames.h"

#include <span>
#include <string>

#include <imgui/imgui.h>

namespace gnomon::viewer {

inline constexpr ImU32 kWarningColor = IM_COL32(255, 190, 90, 255);

/// The height of letters, by which everything is scaled.
float letterHeight();

/// Begins a window that takes nothing from the mouse, at a corner; ImGui::End ends it, whatever is returned.
bool beginNote(const char* name, const ImVec2& at, const ImVec2& pivot);

void drawLine(const std::string& text, ImU32 color = IM_COL32_WHITE);

/// Where a pixel of the framebuffer is for Dear ImGui.
ImVec2 onScreen(const glm::dvec2& pixel);

/// The whole window as a picture that `camera` sees.
PictureFrame windowFrame(const Camera& camera);

/// Draws segments, which may end anywhere, behind all notes.
void drawSegments(std::span<const PixelSegment> segments, ImU32 color, float thickness);

} // namespace gnomon::viewer
