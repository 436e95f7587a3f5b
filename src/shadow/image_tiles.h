// An image divided into square tiles, and a mask that selects some of the tiles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace gnomon::shadow {

/// The tiles of an image, row by row from the lower left corner. Tiles at the right and upper border may be smaller.
struct ImageTiles {
    static constexpr int kSide = 32; // pixels

    int width = 0; // width of the image, pixels
    int height = 0;

    int columns() const { return (width + kSide - 1) / kSide; }

    int rows() const { return (height + kSide - 1) / kSide; }

    std::size_t count() const { return static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()); }

    /// Returns the index of the tile that contains pixel (x, y). Row y = 0 is the lowest row.
    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y / kSide) * static_cast<std::size_t>(columns()) +
               static_cast<std::size_t>(x / kSide);
    }

    bool operator==(const ImageTiles&) const = default;
};

/// A set of image tiles.
struct TileMask {
    ImageTiles tiles;
    std::vector<bool> wanted; // one entry per tile

    bool holds(int x, int y) const { return wanted[tiles.at(x, y)]; }

    /// Returns true if a tile of this set contains a pixel with x0 <= x < x1 and y0 <= y < y1. The pixel range must be
    /// within the image and not empty.
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
