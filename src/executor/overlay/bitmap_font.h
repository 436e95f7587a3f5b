// Letters of five by nine dots, for what is written into pictures.
#pragma once

#include "executor/picture.h"

#include <string_view>

namespace gnomon::executor {

/// The height of a line of text in dots, what lies below its letters included, and the width of a letter with its gap.
inline constexpr int kLineDots = 11;
inline constexpr int kLetterDots = 6;

/// Whether there is a letter for `c`; capital letters are written as small ones.
bool hasGlyph(char c);

/// Fills what of a rectangle lies in `picture`.
void fillRectangle(Picture& picture, int x, int y, int width, int height, const Rgb& color);

/// Writes `text` with its upper left corner at (x, y), `dot` pixels a dot; what has no letter is a gap.
void drawText(Picture& picture, int x, int y, int dot, std::string_view text, const Rgb& color);

} // namespace gnomon::executor
