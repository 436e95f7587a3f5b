// A bitmap font of five by nine dots for text in pictures.
#pragma once

#include "render/picture.h"

#include <string_view>

namespace gnomon::render {

/// Height of a line of text and width of a letter, in dots of the font. The height includes descenders, and the width
/// includes the gap after the letter.
inline constexpr int kLineDots = 11;
inline constexpr int kLetterDots = 6;

/// Returns true if the font contains the character `c`. Capital letters use the glyphs of small letters.
bool hasGlyph(char c);

/// Fills a rectangle of `picture` with `color`. The rectangle is clipped to the picture.
void fillRectangle(Picture& picture, int x, int y, int width, int height, const Rgb& color);

/// Draws `text` into `picture`, with its upper left corner at pixel (x, y). A dot of the font has `dot` x `dot` pixels.
/// A letter without a glyph becomes a gap.
void drawText(Picture& picture, int x, int y, int dot, std::string_view text, const Rgb& color);

} // namespace gnomon::render
