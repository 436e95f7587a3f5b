// A bitmap font of five by nine dots for text in pictures.
#pragma once

#include "render/picture.h"

#include <string_view>

namespace gnomon::render {

/// Height of a line of text, including descenders, and width of a letter with the gap after it, both in dots.
inline constexpr int kLineDots = 11;
inline constexpr int kLetterDots = 6;

/// Returns true if the font contains `c`. Capital letters use the glyphs of small letters.
bool hasGlyph(char c);

/// Fills a rectangle, clipped to `picture`.
void fillRectangle(Picture& picture, int x, int y, int width, int height, const Rgb& color);

/// Draws `text` with its upper left corner at (x, y). A dot of the font has `dot` x `dot` pixels. A letter without a
/// glyph becomes a gap.
void drawText(Picture& picture, int x, int y, int dot, std::string_view text, const Rgb& color);

} // namespace gnomon::render
