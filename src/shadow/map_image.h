// Computes the texel position and the depth bias of a shadow map lookup. Both backends use this code. Planning and
// validation use double precision, and drawing uses single precision.
#pragma once

#include "shadow/depth_bias.h"
#include "shadow/texels/packing.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::shadow {

/// The parameters of lookups in one shadow map, for positions in any space with world units. The shaders repeat the
/// functions texelAt and receiverBias.
template <typename Number>
struct MapImage {
    using Vec2 = glm::vec<2, Number, glm::defaultp>;
    using Vec3 = glm::vec<3, Number, glm::defaultp>;
    using Vec4 = glm::vec<4, Number, glm::defaultp>;
    using Mat4 = glm::mat<4, 4, Number, glm::defaultp>;

    Vec3 origin{0}; // subtracted from each position; 0 unless float precision requires another origin
    /// The matrix from an offset (position - origin) to clip space, for drawing casters and for lookups. The viewport
    /// is the map's rectangle in the depth texture. x and y in [-w, w] fill the rectangle including its borders. Depth
    /// times w is in [0, w], and the smallest depth is nearest to the light. w may be 0 or negative behind the centre
    /// of the warp, so casters need homogeneous clipping. Their depth is clamped per fragment. Clip space is centred on
    /// 0, so the matrix has three times the float precision of a matrix to texels.
    Mat4 clipFromOffset{1};
    Vec2 texelScale{1}; // (column, row) in the depth texture = clip.xy / clip.w * texelScale + texelOffset
    Vec2 texelOffset{0};
    /// Row vectors that give the slope of a receiver in the map. Each vector is used in a dot product with the
    /// receiver's plane (N, -N.(p - origin)) at p. byColumn / byDepth is the change of the plane's depth per column,
    /// and byRow / byDepth the change per row, both without sign.
    Vec4 byColumn{0};
    Vec4 byRow{0};
    Vec4 byDepth{0};
    Number unevenX = 0; // change of depth over a texel along x, for a surface with the slope kUnevenSlope
    // change of depth over a texel along z at w = 1, for the slope kUnevenSlope; multiplied by w, and combined with
    // unevenX as a vector length
    Number unevenZ = 0;
    // max distance from the lookup point to a texel centre that the filter reads, in texels (reachTexels)
    Number reach = 0;
    /// 1 if the rows of the map are logarithmic, else 0. With logarithmic rows, the row is ln(clip.w) * texelScale.y +
    /// texelOffset.y, and clip.y is always -1. byRow is then valid at w = 1 and must be divided by w, and unevenZ does
    /// not depend on w.
    Number logRows = 0;
    /// 1 for the map of a point light, else 0. For a point light, the change of depth over a texel for the slope
    /// kUnevenSlope is `unevenX` / w along x and `unevenZ` / w along z, where w is the distance along the axis of the
    /// cube face.
    Number fromPoint = 0;
};

using DoubleMapImage = MapImage<double>;
using FloatMapImage = MapImage<float>;

/// The texel position and the depth of a lookup in the depth texture.
template <typename Number>
struct MapTexel {
    Number column = 0; // column in the depth texture; whole numbers are texel edges
    Number row = 0;
    Number depth = 0; // depth of the receiver without bias; 0 is nearest to the light
    Number w = 1;
};

/// Returns the position in the depth texture at which point `p` looks up its shadow, and its depth. The result is valid
/// only if w > 0.
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

/// Returns the depth bias for a receiver at `p` with flat unit normal `normal`, to be subtracted from its depth.
/// `cosine` (> 0) is the cosine between normal and light. The bias is the change of depth over the reach of the filter,
/// for the receiver's plane and a steeper neighbour (kUnevenSlope), plus the rounding error.
template <typename Number>
Number receiverBias(
    const MapImage<Number>& image,
    const glm::vec<3, Number, glm::defaultp>& p,
    const glm::vec<3, Number, glm::defaultp>& normal,
    Number cosine) {
    using Vec4 = typename MapImage<Number>::Vec4;
    constexpr auto kMinDivisor = static_cast<Number>(1e-30);
    const auto offset = p - image.origin;
    const Vec4 plane(normal, -glm::dot(normal, offset));
    const Number across = std::max(std::abs(glm::dot(plane, image.byDepth)), kMinDivisor);
    const Vec4 clip = image.clipFromOffset * Vec4(offset, 1);
    const Number w = clip.w;
    const bool isEven = image.logRows == 0;
    const Number byRow = std::abs(glm::dot(plane, image.byRow)) / (isEven ? Number{1} : w);
    const Number steep = std::abs(glm::dot(plane, image.byColumn)) + byRow;
    const Number slope = steep / across * std::min(Number{1}, cosine / static_cast<Number>(kMinCosine));
    const Number alongZ = image.unevenZ * (isEven ? w : Number{1});
    const Number uneven =
        image.fromPoint == 0 ? std::hypot(image.unevenX, alongZ) : std::hypot(image.unevenX, image.unevenZ) / w;
    return (slope + uneven) * image.reach + static_cast<Number>(kDepthRounding);
}

/// Returns the clip-space positions of `count` texture rows from `firstRow` on: y / w at the row centres. Returns an
/// empty list if the rows of `image` are evenly spaced.
std::vector<float> rowPositions(const FloatMapImage& image, int firstRow, int count);

/// Returns the lookup parameters `image` in single precision. Each number is rounded once.
FloatMapImage rounded(const DoubleMapImage& image);

} // namespace gnomon::shadow
