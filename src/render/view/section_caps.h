// Draws the caps of section planes: filled cuts through solid parts of the model, and outlines of open surfaces.
#pragma once

#include "render/backend.h"
#include "render/view/cap_buffers.h"

#include <span>

namespace gnomon::render {

/// First id in the visibility buffer that denotes a section cap. All ids from this number on are caps, not triangles.
constexpr std::uint32_t kFirstCapName = 0xFFFFFF00U;

constexpr bool isCapName(std::uint32_t name) {
    return name >= kFirstCapName;
}

/// Draws the caps of the section planes of `frame` into the visibility buffer `words`, in front of the geometry behind
/// them. A cap fills the inside of closed surfaces, whose intersection lines with the plane are closed. Surfaces can
/// overlap, because each pixel has a winding number. Open surfaces show only their intersection lines.
void drawCaps(const DrawInputs& frame, std::span<std::uint64_t> words);

/// Returns the colour of a section cap. `name` is its id in the visibility buffer.
Rgb capColor(const DrawInputs& frame, std::uint32_t name);

} // namespace gnomon::render
