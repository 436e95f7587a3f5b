#include "shadow/texels/texel_budget.h"

#include "core/check.h"
#include "core/limit_error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::shadow {

namespace {

constexpr double kErrorStep = 1.0005; // relative precision of the search for the min aliasing

/// Returns the smallest number of texels, within the limits, for which the aliasing `demand` / texels is at most
/// `error`.
int sideFor(double demand, double error, const TexelLimits& limits) {
    const int largest = limits.maxSide - 2 * limits.gutter;
    const double wanted = std::ceil(demand / error * (1 - 1e-12)) + limits.margin;
    return wanted >= largest ? largest : std::max(static_cast<int>(wanted), limits.minSide);
}

std::vector<TexelRectangle> sizesFor(std::span<const TexelDemand> demands, double error, const TexelLimits& limits) {
    std::vector<TexelRectangle> sizes;
    sizes.reserve(demands.size());
    for (const TexelDemand& demand : demands)
        sizes.push_back(
            {0,
             0,
             sideFor(demand.s, error, limits) + 2 * limits.gutter,
             sideFor(demand.t, error, limits) + 2 * limits.gutter,
             false});
    return sizes;
}

/// Returns the max aliasing of the maps if their areas with borders fill the texel budget exactly, without losses by
/// rounding and packing. No layout of rectangles has a smaller aliasing. With x = 1 / aliasing, the function solves
/// (sum st) x^2 + 2g (sum s + t) x + 4 g^2 k = texels for its positive root.
double errorOfAreas(std::span<const TexelDemand> demands, const TexelLimits& limits) {
    double square = 0;
    double linear = 0;
    for (const TexelDemand& demand : demands) {
        square += demand.s * demand.t;
        linear += 2.0 * limits.gutter * (demand.s + demand.t);
    }
    const double gutters = 4.0 * limits.gutter * limits.gutter * static_cast<double>(demands.size());
    const double rest = static_cast<double>(limits.texels) - gutters;
    if (!(rest > 0)) return 0;
    // This form of the root has no cancellation and is also valid if `square` is 0.
    return (linear + std::sqrt(linear * linear + 4 * square * rest)) / (2 * rest);
}

TexelLayout equalSquares(std::size_t count, const TexelLimits& limits) {
    TexelLayout layout;
    layout.gutter = limits.gutter;
    layout.margin = limits.margin;
    layout.equalSquares = true;
    auto side = static_cast<int>(std::sqrt(static_cast<double>(limits.texels) / static_cast<double>(count)));
    side = std::min(side, limits.maxSide);
    const int minOuterSide = limits.minSide + 2 * limits.gutter;
    // A single row of squares always fits the texel budget. If the max side of the texture excludes a single row, other
    // layouts leave texels unused, so the loop tries smaller squares.
    for (; side >= minOuterSide; side -= std::max(1, side / 64)) {
        const std::vector<TexelRectangle> squares(count, TexelRectangle{0, 0, side, side, false});
        layout.packing = packed(squares, limits.maxSide, limits.mayTranspose);
        if (layout.packing.width > 0 && layout.packing.area() <= limits.texels) return layout;
    }
    throw LimitError(
        Limit::ShadowTexels,
        {"shadow texels",
         "the budget is too small",
         "at least " +
             std::to_string(count * static_cast<std::size_t>(minOuterSide) * static_cast<std::size_t>(minOuterSide)) +
             " texels for " + std::to_string(count) + " maps",
         std::to_string(limits.texels)});
}

double worstError(const TexelLayout& layout, std::span<const TexelDemand> demands) {
    double worst = 0;
    for (std::size_t i = 0; i < demands.size(); ++i)
        worst = std::max(worst, mapError(layout, i, demands[i]));
    return worst;
}

/// A texture layout that the search tried, and its area divided by the texel budget. The layout fits if `excess` is at
/// most 1.
struct Attempt {
    TexelLayout layout;
    double excess = 1.1; // 1.1 if the max side permits no layout
};

Attempt attemptAt(
    std::span<const TexelDemand> demands, double error, const PackingStrategy& strategy, const TexelLimits& limits) {
    Attempt attempt;
    attempt.layout.packing = packed(sizesFor(demands, error, limits), strategy, limits.maxSide);
    attempt.layout.gutter = limits.gutter;
    attempt.layout.margin = limits.margin;
    const Packing& packing = attempt.layout.packing;
    if (packing.width > 0) attempt.excess = static_cast<double>(packing.area()) / static_cast<double>(limits.texels);
    return attempt;
}

} // namespace

double mapError(const TexelLayout& layout, std::size_t map, const TexelDemand& demand) {
    return std::max(demand.s / (layout.texelsS(map) - layout.margin), demand.t / (layout.texelsT(map) - layout.margin));
}

TexelLayout splitTexels(std::span<const TexelDemand> demands, const TexelLimits& limits) {
    GNOMON_CHECK_OP(demands.size(), >=, std::size_t{1});
    TexelLayout best = equalSquares(demands.size(), limits);
    double bestError = worstError(best, demands);
    const double bound = errorOfAreas(demands, limits);
    if (!(bound > 0)) return best;
    PackingStrategy strategy = bestStrategy(sizesFor(demands, bound, limits), limits.maxSide, limits.mayTranspose);
    // The search starts at the lower bound of the aliasing. First it increases the aliasing in steps that depend on the
    // excess area. Then it bisects the last step.
    double tooSmall = 0;
    double sufficient = 0;
    double error = bound;
    for (int i = 0; i < 24 && (sufficient == 0 || sufficient > tooSmall * kErrorStep); ++i) {
        Attempt attempt = attemptAt(demands, error, strategy, limits);
        if (attempt.excess > 1) {
            tooSmall = error;
        } else {
            // The packing strategy that was chosen at the lower bound may be unsuitable because of the max side. The
            // search then chooses a strategy again, at an aliasing for which all maps fit.
            if (sufficient == 0)
                strategy = bestStrategy(sizesFor(demands, error, limits), limits.maxSide, limits.mayTranspose);
            if (sufficient == 0) tooSmall = bound;
            sufficient = error;
            const double reached = worstError(attempt.layout, demands);
            if (reached < bestError) best = std::move(attempt.layout);
            bestError = std::min(bestError, reached);
        }
        const double next = error * std::max(std::sqrt(attempt.excess), kErrorStep);
        error = sufficient > 0 ? (tooSmall + sufficient) / 2 : next;
    }
    // Unused texels refine one axis of an adjacent map. The other axis of this map preserves the common aliasing. Maps
    // that snap to texels must stay square.
    if (!best.equalSquares && limits.margin == 0) growIntoGaps(best.packing, limits.maxSide);
    return best;
}

std::uint64_t requiredTexels(std::span<const TexelDemand> demands, double aliasing, const TexelLimits& limits) {
    GNOMON_CHECK_OP(aliasing, >, 0.0);
    const Packing rectangles = packed(sizesFor(demands, aliasing, limits), limits.maxSide, limits.mayTranspose);
    if (rectangles.width == 0) return 0;
    const std::uint64_t minOuterSide = static_cast<std::uint32_t>(limits.minSide + 2 * limits.gutter);
    TexelLimits sufficient = limits;
    sufficient.texels = std::max(rectangles.area(), minOuterSide * minOuterSide * demands.size());
    // The search of splitTexels stops slightly above the min error, and may choose another strategy. The loop therefore
    // verifies the number, and increases it if necessary.
    for (int attempt = 0; attempt < 64; ++attempt) {
        if (worstError(splitTexels(demands, sufficient), demands) <= aliasing) return sufficient.texels;
        sufficient.texels += sufficient.texels / 100 + 64;
    }
    return 0;
}

} // namespace gnomon::shadow
