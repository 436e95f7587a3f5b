// The elements of notes over the image: small windows at fixed places, lines of text, and line segments.
#pragma once

#include "viewer/panel/wire_frames.h"

#include <span>
#include <string>

#include <imgui/imgui.h>

namespace gnomon::viewer {

inline constexpr ImU32 kWarningColor = IM_COL32(255, 190, 90, 255);

/// Returns the height of letters, the unit of all distances.
float letterHeight();

/// Begins a window at a corner that ignores the mouse. The caller must call ImGui::End for any result.
bool beginNote(const char* name, const ImVec2& at, const ImVec2& pivot);

/// Draws a line of text in the current window.
void drawLine(const std::string& text, ImU32 color = IM_COL32_WHITE);

/// Converts a pixel of the framebuffer to the coordinates of Dear ImGui.
ImVec2 onScreen(const glm::dvec2& pixel);

/// Returns the picture frame that covers the whole window, for projections with `camera`.
PictureFrame windowFrame(const Camera& camera);

/// Draws segments of any length behind all notes.
void drawSegments(std::span<const PixelSegment> segments, ImU32 color, float thickness);

} // namespace gnomon::viewer
