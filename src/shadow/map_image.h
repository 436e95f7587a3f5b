// A shadow map as a lookup sees it: the numbers that both executors are given, and what they compute with them. In
// double it is the map that is planned and proven, rounded to float the one that is drawn.
#pragma once

#include "shadow/depth_bias.h"
#include "shadow/texels/packing.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::shadow {

/// One map for positions in a space of world units, whose axes may be any. Shaders repeat texelAt and receiverBias.
template <typename Number>
struct MapImage {
    using Vec2 = glm::vec<2, Number, glm::defaultp>;
    using Vec3 = glm::vec<3, Number, glm::defaultp>;
    using Vec4 = glm::vec<4, Number, glm::defaultp>;
    using Mat4 = glm::mat<4, 4, Number, glm::defaultp>;

    Vec3 origin{0}; // positions are taken relative to it before anything else; 0 unless floats need it
    /// Clip space to draw the casters with and to look up in, viewport = the map's rectangle: x and y in [-w, w] fill
    /// it gutters included, depth w in [0, w] with the smallest nearest to the light. w may be 0 or negative behind the
    /// warp's centre: clip homogeneously, and clamp depth per fragment. Centred on 0 it is three times as exact in
    /// single precision as a matrix to texels would be.
    Mat4 clipFromOffset{1};
    Vec2 texelScale{1}; // (column, row) in the depth texture = clip.xy / clip.w * texelScale + texelOffset
    Vec2 texelOffset{0};
    /// Products with a receiver's plane (N, -N.(p - origin)): byColumn / byDepth is what its depth changes by from one
    /// column to the next, byRow / byDepth likewise, but for the sign.
    Vec4 byColumn{0};
    Vec4 byRow{0};
    Vec4 byDepth{0};
    Number unevenX = 0; // depth that kUnevenSlope changes over a texel along x
    Number unevenZ = 0; // and along z where w is 1: times w; the unevenness is the length of both
    Number reach = 0;   // reachTexels
    /// 1 where rows lie logarithmically, else 0. The row is then ln(clip.w) * texelScale.y + texelOffset.y, clip.y is
    /// -1 everywhere, byRow is what it is where w is 1, to be divided by w, and unevenZ is the same everywhere.
    Number logRows = 0;
    /// 1 where the map is a point light's, else 0. What unevenness changes in depth over a texel, along x and along z,
    /// is then `unevenX` and `unevenZ` over w, the distance along the axis.
    Number fromPoint = 0;
};

using DoubleMapImage = MapImage<double>;
using FloatMapImage = MapImage<float>;

/// Where a lookup reads.
template <typename Number>
struct MapTexel {
    Number column = 0; // in the depth texture, whole numbers on the edges of texels
    Number row = 0;
    Number depth = 0; // 0 nearest to the light, before the bias
    Number w = 1;
};

/// Where `p` lies in the map. Only meaningful where w > 0.
template <typename Number>
MapTexel<Number> texelAt(const MapImage<Number>& image, const glm::vec<3, Number, glm::defaultp>& p) {
    const auto clip = image.clipFromOffset * typename MapImage<Number>::Vec4(p - image.origin, 1);
    const Number up = image.logRows == 0 ? clip.y / clip.w : std::log(clip.w);
    return {
        clip.x / clip.w * image.texelScale.x + image.texelOffset.x,
        up * image.texelScale.y + image.texelOffset.y,
        clip.z / clip.w,
        clip.w};
}

/// What to subtract from the depth of a receiver at `p` with flat unit normal `normal` and cosine `cosine` (above 0) to
/// the light: what its plane, and a neighbour somewhat steeper, may change in depth over the reach, and rounding.
template <typename Number>
Number receiverBias(
    const MapImage<Number>& image,
    const glm::vec<3, Number, glm::defaultp>& p,
    const glm::vec<3, Number, glm::defaultp>& normal,
    Number cosine) {
    using Vec4 = typename MapImage<Number>::Vec4;
    constexpr auto kLeastDivisor = static_cast<Number>(1e-30);
    const auto offset = p - image.origin;
    const Vec4 plane(normal, -glm::dot(normal, offset));
    const Number across = std::max(std::abs(glm::dot(plane, image.byDepth)), kLeastDivisor);
    const Vec4 clip = image.clipFromOffset * Vec4(offset, 1);
    const Number w = clip.w;
    const bool isEven = image.logRows == 0;
    const Number byRow = std::abs(glm::dot(plane, image.byRow)) / (isEven ? Number{1} : w);
    const Number steep = std::abs(glm::dot(plane, image.byColumn)) + byRow;
    const Number slope = steep / across * std::min(Number{1}, cosine / static_cast<Number>(kLeastCosine));
    const Number alongZ = image.unevenZ * (isEven ? w : Number{1});
    const Number uneven =
        image.fromPoint == 0 ? std::hypot(image.unevenX, alongZ) : std::hypot(image.unevenX, image.unevenZ) / w;
    return (slope + uneven) * image.reach + static_cast<Number>(kDepthRounding);
}

/// Where the rows of the texture that `image` fills from `firstRow` on lie, y / w of their middles, if
/// logarithmically; else nothing.
std::vector<float> rowPositions(const FloatMapImage& image, int firstRow, int count);

/// The image in single precision, each number rounded once.
FloatMapImage rounded(const DoubleMapImage& image);

} // namespace gnomon::shadow
