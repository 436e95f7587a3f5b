#include "tests/executor/executor_comparison.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon::executor {
namespace {

void compareMaps(const FloatPicture& a, const FloatPicture& b, ExecutorDifference& found) {
    GNOMON_CHECK_OP(a.pixels.size(), ==, b.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const bool isA = a.pixels[i] < 1;
        const bool isB = b.pixels[i] < 1;
        if (isA != isB) ++found.texelCover;
        if (!isA || !isB) continue;
        ++found.texels;
        const double depth = std::abs(double{a.pixels[i]} - double{b.pixels[i]});
        if (depth > 1e-5) ++found.texelWrong;
        found.largestTexelDepth = std::max(found.largestTexelDepth, depth);
    }
}

} // namespace

void ExecutorDifference::operator+=(const ExecutorDifference& other) {
    pixels += other.pixels;
    coverage += other.coverage;
    color += other.color;
    lit += other.lit;
    texels += other.texels;
    texelCover += other.texelCover;
    texelWrong += other.texelWrong;
    largestTexelDepth = std::max(largestTexelDepth, other.largestTexelDepth);
}

ExecutorDifference difference(Executor& a, Executor& b) {
    ExecutorDifference found;
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

} // namespace gnomon::executor
