#include "shadow/texels/packing.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace gnomon::shadow {

namespace {

/// A step of the skyline, the upper outline of the packed rectangles: from `x` to the next step, the area below
/// `height` is occupied.
struct Step {
    int x;
    int height;
};

/// Returns the lowest free height for a rectangle of `width` texels whose left side is at step `first` of the skyline.
/// Returns INT_MAX if the rectangle would extend beyond `limit`.
int restingHeight(const std::vector<Step>& steps, std::size_t first, int width, int limit) {
    const int right = steps[first].x + width;
    if (right > limit) return std::numeric_limits<int>::max();
    int height = 0;
    for (std::size_t i = first; i < steps.size() && steps[i].x < right; ++i)
        height = std::max(height, steps[i].height);
    return height;
}

void raise(std::vector<Step>& steps, std::size_t first, int width, int height) {
    const int left = steps[first].x;
    const int right = left + width;
    std::size_t last = first;
    while (last + 1 < steps.size() && steps[last + 1].x <= right)
        ++last;
    const Step rest{right, steps[last].height};
    const bool covered = last + 1 < steps.size() ? steps[last + 1].x == right : false;
    steps.erase(
        steps.begin() + static_cast<std::ptrdiff_t>(first), steps.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    const auto at = steps.begin() + static_cast<std::ptrdiff_t>(first);
    if (covered)
        steps.insert(at, {left, height});
    else
        steps.insert(at, {Step{left, height}, rest});
}

/// Packs rectangles in the given `order` into a strip of `width` texels, each at the lowest and then leftmost position.
/// Returns an empty packing if the height would exceed `maxSide`.
Packing skyline(
    std::span<const TexelRectangle> rectangles, std::span<const std::size_t> order, int width, int maxSide) {
    Packing packing;
    packing.rectangles.assign(rectangles.begin(), rectangles.end());
    std::vector<Step> steps{{0, 0}};
    for (const std::size_t index : order) {
        TexelRectangle& rectangle = packing.rectangles[index];
        std::size_t best = 0;
        int bestHeight = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const int height = restingHeight(steps, i, rectangle.width, width);
            if (height < bestHeight) {
                bestHeight = height;
                best = i;
            }
        }
        if (bestHeight > maxSide - rectangle.height) return {};
        rectangle.x = steps[best].x;
        rectangle.y = bestHeight;
        packing.width = std::max(packing.width, rectangle.x + rectangle.width);
        packing.height = std::max(packing.height, bestHeight + rectangle.height);
        raise(steps, best, rectangle.width, bestHeight + rectangle.height);
    }
    return packing;
}

bool better(const Packing& a, const Packing& b) {
    if (a.width == 0 || b.width == 0) return a.width != 0;
    if (a.area() != b.area()) return a.area() < b.area();
    return std::max(a.width, a.height) < std::max(b.width, b.height);
}

bool allAlike(std::span<const TexelRectangle> rectangles) {
    const TexelRectangle& first = rectangles.front();
    return std::all_of(rectangles.begin(), rectangles.end(), [&](const TexelRectangle& other) {
        return other.width == first.width && other.height == first.height;
    });
}

/// Packs rectangles of equal size into a grid with `columns` columns.
Packing grid(std::span<const TexelRectangle> rectangles, int columns, int maxSide) {
    const int count = static_cast<int>(rectangles.size());
    const int rows = (count + columns - 1) / columns;
    int width = 0;
    int height = 0;
    for (const TexelRectangle& rectangle : rectangles) {
        width = std::max(width, rectangle.width);
        height = std::max(height, rectangle.height);
    }
    if (columns > maxSide / width || rows > maxSide / height) return {};
    Packing packing{columns * width, rows * height, {rectangles.begin(), rectangles.end()}};
    for (int i = 0; i < count; ++i) {
        packing.rectangles[static_cast<std::size_t>(i)].x = i % columns * width;
        packing.rectangles[static_cast<std::size_t>(i)].y = i / columns * height;
    }
    return packing;
}

std::vector<TexelRectangle> transposedAs(
    std::span<const TexelRectangle> rectangles, PackingStrategy::Transposition transposition) {
    std::vector<TexelRectangle> result(rectangles.begin(), rectangles.end());
    for (TexelRectangle& rectangle : result) {
        const bool isTall = rectangle.height >= rectangle.width;
        rectangle.transposed = (transposition == PackingStrategy::Transposition::AllTall && !isTall) ||
                               (transposition == PackingStrategy::Transposition::AllWide && isTall);
        if (rectangle.transposed) std::swap(rectangle.width, rectangle.height);
    }
    return result;
}

std::vector<std::size_t> orderOf(std::span<const TexelRectangle> rectangles, PackingStrategy::Order kind) {
    std::vector<std::size_t> order(rectangles.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (kind == PackingStrategy::Order::Area) return rectangles[a].area() > rectangles[b].area();
        return rectangles[a].height > rectangles[b].height;
    });
    return order;
}

/// Returns the width of a texture strip that contains the first `row` rectangles of `order` side by side. The strip is
/// at least as wide as the widest rectangle.
int stripWidth(std::span<const TexelRectangle> rectangles, std::span<const std::size_t> order, int row) {
    std::int64_t sum = 0;
    int widest = 0;
    for (int i = 0; i < row; ++i)
        sum += rectangles[order[static_cast<std::size_t>(i)]].width;
    for (const TexelRectangle& rectangle : rectangles)
        widest = std::max(widest, rectangle.width);
    return static_cast<int>(std::min<std::int64_t>(std::max<std::int64_t>(sum, widest), 1 << 30));
}

PackingStrategy bestGrid(std::span<const TexelRectangle> rectangles, int maxSide) {
    PackingStrategy best;
    Packing densest;
    for (int columns = 1; columns <= static_cast<int>(rectangles.size()); ++columns) {
        const Packing candidate = grid(rectangles, columns, maxSide);
        if (!better(candidate, densest)) continue;
        densest = candidate;
        best.columns = columns;
    }
    return best;
}

} // namespace

Packing packed(std::span<const TexelRectangle> rectangles, const PackingStrategy& strategy, int maxSide) {
    if (rectangles.empty()) return {};
    if (strategy.row == 0) return grid(rectangles, strategy.columns, maxSide);
    const std::vector<TexelRectangle> transposed = transposedAs(rectangles, strategy.transposition);
    const std::vector<std::size_t> order = orderOf(transposed, strategy.order);
    const int width = stripWidth(transposed, order, strategy.row);
    return width > maxSide ? Packing{} : skyline(transposed, order, width, maxSide);
}

PackingStrategy bestStrategy(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose) {
    if (rectangles.empty()) return {};
    if (allAlike(rectangles)) return bestGrid(rectangles, maxSide);
    using Transposition = PackingStrategy::Transposition;
    using Order = PackingStrategy::Order;
    PackingStrategy best;
    Packing densest;
    for (const Transposition transposition : {Transposition::AsGiven, Transposition::AllTall, Transposition::AllWide}) {
        if (transposition != Transposition::AsGiven && !mayTranspose) break;
        const std::vector<TexelRectangle> transposed = transposedAs(rectangles, transposition);
        for (const Order order : {Order::Height, Order::Area}) {
            const std::vector<std::size_t> sorted = orderOf(transposed, order);
            for (int row = 1; row <= static_cast<int>(rectangles.size()); ++row) {
                const int width = stripWidth(transposed, sorted, row);
                if (width > maxSide) break;
                Packing candidate = skyline(transposed, sorted, width, maxSide);
                if (!better(candidate, densest)) continue;
                densest = std::move(candidate);
                best = {transposition, order, row, 1};
            }
        }
    }
    return best;
}

void growIntoGaps(Packing& packing, int maxSide) {
    for (TexelRectangle& r : packing.rectangles) {
        int right = std::min(packing.width, r.x + maxSide);
        int top = std::min(packing.height, r.y + maxSide);
        for (const TexelRectangle& other : packing.rectangles) {
            const bool beside = other.y < r.y + r.height && r.y < other.y + other.height;
            const bool above = other.x < r.x + r.width && r.x < other.x + other.width;
            if (beside && other.x >= r.x + r.width) right = std::min(right, other.x);
            if (above && other.y >= r.y + r.height) top = std::min(top, other.y);
        }
        const std::int64_t wider = static_cast<std::int64_t>(right - r.x - r.width) * r.height;
        const std::int64_t taller = static_cast<std::int64_t>(top - r.y - r.height) * r.width;
        if (wider >= taller)
            r.width = right - r.x;
        else
            r.height = top - r.y;
    }
}

Packing packed(std::span<const TexelRectangle> rectangles, int maxSide, bool mayTranspose) {
    return packed(rectangles, bestStrategy(rectangles, maxSide, mayTranspose), maxSide);
}

} // namespace gnomon::shadow
