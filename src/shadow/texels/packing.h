// Packing of rectangles into one texture with a small area.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// A rectangle of texels in the packed texture, borders included.
struct TexelRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool transposed = false; // true: the s axis of the map runs along y, its t axis along x

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }

    bool operator==(const TexelRectangle&) const = default;
};

/// A texture with disjoint rectangles. The width is 0 if no texture of the allowed size can hold them.
struct Packing {
    int width = 0;
    int height = 0;
    std::vector<TexelRectangle> rectangles; // in input order

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// The parameters of a layout. They lay out the same set of rectangles in the same way at another scale.
struct PackingStrategy {
    enum class Transposition : std::uint8_t { AsGiven, AllTall, AllWide };
    enum class Order : std::uint8_t { Height, Area };

    Transposition transposition = Transposition::AsGiven;
    Order order = Order::Height;
    int row = 0; // the strip is as wide as the first `row` rectangles in order; 0: a grid with `columns` columns
    int columns = 1;
};

/// Returns the strategy with the smallest area for `rectangles` and texture sides of at most `maxSide`. It ignores the
/// x, y and transposition of the rectangles. Equal rectangles get a grid. Other sets get a skyline packing
/// (bottom-left), tried for each strip width that is the sum of the first rectangles. The search suits at most a few
/// hundred rectangles. Without `mayTranspose`, each rectangle stays upright.
PackingStrategy bestStrategy(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

/// Returns `rectangles` laid out by `strategy`. Returns an empty packing (width 0) if a side would exceed `maxSide`.
Packing packed(std::span<const TexelRectangle> rectangles, const PackingStrategy& strategy, int maxSide);

/// Enlarges each rectangle along one axis into adjacent free texels, up to `maxSide`.
void growIntoGaps(Packing& packing, int maxSide);

/// Returns `rectangles` laid out by their best strategy.
Packing packed(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

} // namespace gnomon::shadow
