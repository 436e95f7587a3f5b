// The caps of section planes: where what is solid is cut through, and the lines of what is not closed.
#pragma once

#include "executor/executor.h"
#include "executor/view/cap_buffers.h"

#include <span>

namespace gnomon::executor {

/// Names in the visibility buffer from here on are those of caps, no triangles.
constexpr std::uint32_t kFirstCapName = 0xFFFFFF00U;

constexpr bool isCapName(std::uint32_t name) {
    return name >= kFirstCapName;
}

/// Writes the section planes of `frame` into the words of its image, over what is kept behind them. A plane shows the
/// inside of closed surfaces, those whose cuts by it are closed lines, whatever they overlap: each pixel counts how
/// often such lines go around it (the winding number). Of all others it shows the lines alone.
void drawCaps(const FrameDrawing& frame, std::span<std::uint64_t> words);

/// The colour of what a cap's name stands for.
Rgb capColor(const FrameDrawing& frame, std::uint32_t name);

} // namespace gnomon::executor
