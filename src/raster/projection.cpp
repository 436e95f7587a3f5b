#include "raster/projection.h"

#include "raster/uneven/row_bands.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace gnomon::raster {
namespace {

float guardFactor(int pixels) {
    return std::exp2(std::floor(std::log2(kGuardPixels / (0.5F * static_cast<float>(std::max(pixels, 1))))));
}

float row(const Projection& projection, std::size_t i, const std::array<float, 3>& p) {
    const auto& m = projection.clipFromCell;
    return ((m[i] * p[0] + m[4 + i] * p[1]) + m[8 + i] * p[2]) + m[12 + i];
}

} // namespace

Projection projection(const View& view, bool cutsDepth, const RowBands* rows) {
    Projection p;
    for (int column = 0; column < 4; ++column)
        for (int i = 0; i < 4; ++i)
            p.clipFromCell[4 * static_cast<std::size_t>(column) + static_cast<std::size_t>(i)] =
                view.clipFromCell[column][i];
    for (int axis = 0; axis < 3; ++axis)
        p.eyeCell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(view.eyeCell[axis]);
    p.guardX = guardFactor(view.viewport.width());
    p.guardY = guardFactor(view.viewport.height());
    p.scaleX = 0.5F * static_cast<float>(view.viewport.width());
    p.scaleY = 0.5F * static_cast<float>(view.viewport.height());
    p.translateX = static_cast<float>(view.viewport.x0) + p.scaleX;
    p.translateY = static_cast<float>(view.viewport.y0) + p.scaleY;
    p.cutsDepth = cutsDepth;
    p.rows = rows;
    if (rows != nullptr) {
        p.guardY = rows->guard();
        p.lowY = rows->lowest();
        p.highY = rows->highest();
    }
    return p;
}

ClipPosition clipPosition(const Projection& projection, const std::uint32_t* position) {
    std::array<float, 3> p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
        p[axis] = static_cast<float>(static_cast<std::int32_t>(position[axis] - projection.eyeCell[axis]));
    return {row(projection, 0, p), row(projection, 1, p), row(projection, 2, p), row(projection, 3, p)};
}

SnappedVertex snapped(const Projection& projection, const ClipPosition& p) {
    const float inverseW = 1.0F / p.w;
    const float x = p.x * inverseW * projection.scaleX + projection.translateX;
    const float yOverW = p.y * inverseW;
    const float y = yOverW * projection.scaleY + projection.translateY;
    // Adding +0 converts a depth of -0 to +0, whose bits sort correctly as an integer.
    const float z = std::min(std::max(p.z * inverseW, -kDepthLimit), kDepthLimit) + 0.0F;
    if (projection.rows != nullptr) return unevenTo(double{(x - 0.5F) * static_cast<float>(kSubpixels)}, yOverW, z);
    return snappedTo(
        double{(x - 0.5F) * static_cast<float>(kSubpixels)}, double{(y - 0.5F) * static_cast<float>(kSubpixels)}, z);
}

SnappedVertex snappedTo(double x, double y, float z) {
    SnappedVertex vertex{static_cast<std::int32_t>(std::lrint(x)), static_cast<std::int32_t>(std::lrint(y)), z, 0, 0};
    const auto rest = [](double whole, std::int32_t snapped) {
        constexpr double kMaxRest = 32767; // max remainder; a remainder of half a subpixel would be 32768
        return static_cast<std::int16_t>(std::lrint(std::min((whole - snapped) * (1 << kRestBits), kMaxRest)));
    };
    vertex.restX = rest(x, vertex.x);
    vertex.restY = rest(y, vertex.y);
    return vertex;
}

SnappedVertex unevenTo(double x, float yOverW, float z) {
    SnappedVertex vertex = snappedTo(x, 0, z);
    vertex.y = std::bit_cast<std::int32_t>(yOverW);
    return vertex;
}

std::uint32_t outsideBits(const Projection& projection, const ClipPosition& p) {
    std::uint32_t bits = (p.x < projection.lowX * p.w ? 1U : 0U) | (p.x > projection.highX * p.w ? 2U : 0U) |
                         (p.y < projection.lowY * p.w ? 4U : 0U) | (p.y > projection.highY * p.w ? 8U : 0U);
    if (projection.cutsDepth) bits |= (p.z > p.w ? 16U : 0U) | (p.z < 0 ? 32U : 0U);
    return bits;
}

} // namespace gnomon::raster
