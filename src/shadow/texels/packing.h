// Packs the rectangles of shadow maps into one texture with a small area.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// The rectangle of a shadow map in the packed texture, borders included.
struct TexelRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool transposed = false; // true: the s axis of the map runs along y, its t axis along x

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }

    bool operator==(const TexelRectangle&) const = default;
};

/// A texture with the disjoint rectangles of shadow maps. If no texture of the allowed size can contain them, the width
/// is 0.
struct Packing {
    int width = 0;
    int height = 0;
    std::vector<TexelRectangle> rectangles; // in input order

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// The parameters with which packed() arranges rectangles in a texture. If all rectangles are scaled equally, the same
/// parameters give the same arrangement.
struct PackingStrategy {
    enum class Transposition : std::uint8_t { AsGiven, AllTall, AllWide };
    enum class Order : std::uint8_t { Height, Area };

    Transposition transposition = Transposition::AsGiven;
    Order order = Order::Height;
    int row = 0; // the rectangles fill a strip as wide as the first `row` of them; 0: a grid with `columns` columns
    int columns = 1;
};

/// Returns the parameters that pack `rectangles` into the smallest area, with texture sides of at most `maxSide`. The
/// x, y and transposition of the rectangles are ignored. Rectangles of equal size are packed in a grid. For other sets,
/// the function tries a skyline packing (bottom-left) for each strip width that is the sum of the widths of the first
/// rectangles. The search is suitable for up to a few hundred rectangles. Without `mayTranspose`, no rectangle is
/// transposed.
PackingStrategy bestStrategy(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

/// Returns `rectangles` packed into a texture with the parameters `strategy`. Returns an empty packing (width 0) if a
/// side would exceed `maxSide`.
Packing packed(std::span<const TexelRectangle> rectangles, const PackingStrategy& strategy, int maxSide);

/// Enlarges each packed rectangle along one axis into adjacent free texels. No side of the texture exceeds `maxSide`.
void growIntoGaps(Packing& packing, int maxSide);

/// Returns `rectangles` packed into the smallest area that bestStrategy finds.
Packing packed(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

} // namespace gnomon::shadow
