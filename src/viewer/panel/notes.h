// Draws notes over the image: small windows at fixed positions, lines of text, and line segments.
#pragma once

#include "viewer/panel/wire_frames.h"

#include <span>
#include <string>

#include <imgui/imgui.h>

namespace gnomon::viewer {

inline constexpr ImU32 kWarningColor = IM_COL32(255, 190, 90, 255);

/// Returns the height of letters in Dear ImGui units. All distances in notes are multiples of it.
float letterHeight();

/// Begins a small window at a fixed position that ignores the mouse. The caller must call ImGui::End even if the result
/// is false.
bool beginNote(const char* name, const ImVec2& at, const ImVec2& pivot);

/// Draws a line of text in the current Dear ImGui window.
void drawLine(const std::string& text, ImU32 color = IM_COL32_WHITE);

/// Converts a position from pixels of the framebuffer to the coordinates of Dear ImGui.
ImVec2 onScreen(const glm::dvec2& pixel);

/// Returns an image area that covers the whole window, onto which `camera` projects line segments.
PictureFrame windowFrame(const Camera& camera);

/// Draws line segments of any length behind all notes.
void drawSegments(std::span<const PixelSegment> segments, ImU32 color, float thickness);

} // namespace gnomon::viewer
