// An image in square tiles: what is told of its parts, and which of them are drawn.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::shadow {

/// The tiles of an image, row by row from its lower left corner; those at its far sides are cut off.
struct ImageTiles {
    static constexpr int kSide = 32; // pixels

    int width = 0; // of the image, pixels
    int height = 0;

    int columns() const { return (width + kSide - 1) / kSide; }

    int rows() const { return (height + kSide - 1) / kSide; }

    std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }

    /// The tile of a pixel, whose row counts from below.
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y / kSide) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(x / kSide);
    }

    bool operator==(const ImageTiles&) const = default;
};

/// Some of them.
struct TileMask {
    ImageTiles tiles;
    std::vector<bool> wanted; // by tile

    bool holds(int x, int y) const { return wanted[tiles.at(x, y)]; }

    /// Whether it holds any pixel of x0 <= x < x1, y0 <= y < y1, which lie in the image and are some.
    bool holdsAny(int x0, int y0, int x1, int y1) const {
        for (int y = y0 / ImageTiles::kSide; y <= (y1 - 1) / ImageTiles::kSide; ++y)
            for (int x = x0 / ImageTiles::kSide; x <= (x1 - 1) / ImageTiles::kSide; ++x)
                if (holds(x * ImageTiles::kSide, y * ImageTiles::kSide)) return true;
        return false;
    }

    std::size_t count() const { return static_cast<std::size_t>(std::count(wanted.begin(), wanted.end(), true)); }

    bool operator==(const TileMask&) const = default;
};

} // namespace gnomon::shadow
