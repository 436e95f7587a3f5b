// Packing of rectangles into one texture of the least area.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::shadow {

/// A rectangle of texels in the packed texture, gutters included.
struct TexelRectangle {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
    bool transposed = false; // lies on its side: the map's s axis runs along y, its t axis along x

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }

    bool operator==(const TexelRectangle&) const = default;
};

/// A texture with its rectangles, disjoint and inside it; width 0 where nothing of the allowed size could hold them.
struct Packing {
    int width = 0;
    int height = 0;
    std::vector<TexelRectangle> rectangles; // in the order of the input

    std::uint64_t area() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// How a set of rectangles is laid out: enough to lay out the same set at another scale in the same way.
struct PackingStrategy {
    enum class Transposition : std::uint8_t { AsGiven, AllTall, AllWide };
    enum class Order : std::uint8_t { Height, Area };

    Transposition transposition = Transposition::AsGiven;
    Order order = Order::Height;
    int row = 0; // the strip is as wide as the first `row` rectangles in order; 0: a grid of `columns`
    int columns = 1;
};

/// The strategy of the least area for `rectangles` (their x, y and transposition are ignored) with sides of at most
/// `maxSide`: a grid where all are alike, else a skyline (bottom-left) over the strips in which a whole number of them
/// stand side by side; upright all, if none may be transposed. At most a few hundred rectangles.
PackingStrategy bestStrategy(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

/// `rectangles` laid out by `strategy`; nothing (width 0) if a side would exceed `maxSide`.
Packing packed(std::span<const TexelRectangle> rectangles, const PackingStrategy& strategy, int maxSide);

/// Lets each rectangle grow along one of its axes into the texels beside it that nothing else takes, up to `maxSide`.
void growIntoGaps(Packing& packing, int maxSide);

/// `rectangles` laid out by their best strategy.
Packing packed(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose = true);

} // namespace gnomon::shadow
