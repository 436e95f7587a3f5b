#include "executor/heat_scale.h"

#include "executor/software_overlay.h"

#include <cmath>
#include <string_view>

namespace gnomon::executor {

namespace {

constexpr int kBarWidth = 180;
constexpr int kBarHeight = 10;
constexpr int kMargin = 10;
constexpr int kDot = 2; // pixels of a dot of a figure
constexpr Rgb kPaper = {20, 24, 30};
constexpr Rgb kInk = {240, 240, 240};

/// Five rows of three dots, the left one in the highest bit.
std::array<int, 5> glyph(char c) {
    switch (c) {
    case '1':
        return {2, 6, 2, 2, 7};
    case '4':
        return {5, 5, 7, 1, 1};
    case '6':
        return {7, 4, 7, 5, 7};
    default: // a slash
        return {1, 1, 2, 4, 4};
    }
}

void fill(Picture& picture, int x, int y, int width, int height, const Rgb& color) {
    for (int row = y; row < y + height; ++row)
        for (int column = x; column < x + width; ++column)
            picture.at(column, row) = color;
}

void write(Picture& picture, int x, int y, std::string_view text) {
    for (const char c : text) {
        const std::array<int, 5> rows = glyph(c);
        for (int row = 0; row < 5; ++row)
            for (int column = 0; column < 3; ++column)
                if ((rows[static_cast<std::size_t>(row)] >> (2 - column) & 1) != 0)
                    fill(picture, x + column * kDot, y + row * kDot, kDot, kDot, kInk);
        x += 4 * kDot;
    }
}

} // namespace

void drawHeatScale(Picture& picture) {
    constexpr int kWidth = kBarWidth + 2 * kMargin;
    constexpr int kHeight = kBarHeight + 5 * kDot + 3 * kMargin / 2;
    if (picture.width < kWidth || picture.height < kHeight) return;
    const int top = picture.height - kHeight;
    fill(picture, 0, top, kWidth, kHeight, kPaper);
    for (int x = 0; x < kBarWidth; ++x) {
        const float exponent = -2 + 6 * (static_cast<float>(x) + 0.5F) / kBarWidth; // from 1/4 to 16
        const glm::vec3 color = heatColor(std::exp2(exponent)) * 255.0F + 0.5F;
        const Rgb rgb = {
            static_cast<std::uint8_t>(color.r), static_cast<std::uint8_t>(color.g), static_cast<std::uint8_t>(color.b)};
        fill(picture, kMargin + x, top + kMargin / 2, 1, kBarHeight, rgb);
    }
    const int figures = top + kBarHeight + kMargin;
    write(picture, kMargin, figures, "1/4");
    write(picture, kMargin + kBarWidth / 3 - 3, figures, "1");
    write(picture, kMargin + 2 * kBarWidth / 3 - 3, figures, "4");
    write(picture, kMargin + kBarWidth - 14, figures, "16");
}

} // namespace gnomon::executor
