#include "tests/support/backend_comparison.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon::render {
namespace {

/// The largest difference between `map` at (x, y) and the texels about it.
double steepest(const FloatPicture& map, int x, int y) {
    double max = 0;
    for (int row = std::max(y - 1, 0); row <= std::min(y + 1, map.height - 1); ++row)
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, map.width - 1); ++column)
            max = std::max(max, std::abs(double{map.at(column, row)} - double{map.at(x, y)}));
    return max;
}

void compareMaps(const FloatPicture& a, const FloatPicture& b, BackendDifference& found) {
    GNOMON_CHECK_OP(a.pixels.size(), ==, b.pixels.size());
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const bool isA = a.at(x, y) < 1;
            const bool isB = b.at(x, y) < 1;
            if (isA != isB) ++found.texelCover;
            if (!isA || !isB) continue;
            ++found.texels;
            const double depth = std::abs(double{a.at(x, y)} - double{b.at(x, y)});
            found.largestTexelDepth = std::max(found.largestTexelDepth, depth);
            if (depth <= 1e-5) continue;
            ++found.texelWrong;
            if (depth > 1e-5 + std::max(steepest(a, x, y), steepest(b, x, y)) / 128) ++found.texelMoved;
        }
}

} // namespace

void BackendDifference::operator+=(const BackendDifference& other) {
    pixels += other.pixels;
    coverage += other.coverage;
    color += other.color;
    lit += other.lit;
    texels += other.texels;
    texelCover += other.texelCover;
    texelWrong += other.texelWrong;
    texelMoved += other.texelMoved;
    largestTexelDepth = std::max(largestTexelDepth, other.largestTexelDepth);
}

BackendDifference difference(Backend& a, Backend& b) {
    BackendDifference found;
    const Picture pictureA = a.picture();
    const Picture pictureB = b.picture();
    const FloatPicture depthA = a.viewDepth();
    const FloatPicture depthB = b.viewDepth();
    for (std::size_t i = 0; i < pictureA.pixels.size(); ++i) {
        ++found.pixels;
        if (std::isinf(depthA.pixels[i]) != std::isinf(depthB.pixels[i])) ++found.coverage;
        int largest = 0;
        for (std::size_t c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(pictureA.pixels[i][c] - pictureB.pixels[i][c]));
        if (largest > 2) ++found.color;
    }
    const std::uint64_t litA = a.litPixels().value_or(0);
    const std::uint64_t litB = b.litPixels().value_or(0);
    found.lit = std::max(litA, litB) - std::min(litA, litB);
    compareMaps(a.shadowDepth(), b.shadowDepth(), found);
    return found;
}

} // namespace gnomon::render
