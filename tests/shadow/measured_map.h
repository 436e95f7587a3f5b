// Measurements of a shadow map at a point, for comparison with its bounds: aliasing by finite differences, depth change
// of the receiver's plane over the filter kernel, and the position of a lookup.
#pragma once

#include "shadow/depth_bias.h"
#include "shadow/map_image.h"
#include "shadow/setup.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

/// A wider number type for measurements. Near a warp's centre of projection, differences cancel, and doubles would
/// measure their own rounding.
using Wide = long double;
using WideVec2 = glm::vec<2, Wide, glm::defaultp>;
using WideVec3 = glm::vec<3, Wide, glm::defaultp>;
using WideVec4 = glm::vec<4, Wide, glm::defaultp>;
using WideMat4 = glm::mat<4, 4, Wide, glm::defaultp>;

/// Returns the image of a map in wide numbers, as far as positions need it.
inline MapImage<Wide> wideImage(const ShadowMap& map) {
    const DoubleMapImage image = cameraImage(map);
    MapImage<Wide> wide;
    wide.origin = WideVec3(image.origin);
    wide.clipFromOffset = WideMat4(image.clipFromOffset);
    wide.texelScale = WideVec2(image.texelScale);
    wide.texelOffset = WideVec2(image.texelOffset);
    wide.logRows = image.logRows;
    wide.fromPoint = image.fromPoint;
    return wide;
}

/// The aliasing of a map at a point.
struct Measured {
    double x = 0;
    double z = 0;
    double sheared = 0;
};

/// Measures the aliasing at `p` by finite differences of the lookup matrix, in texels and pixels.
inline Measured measuredAt(const ShadowMap& map, const ShadowView& view, const glm::dvec3& p) {
    const MapPoint at = mapPoint(map.warped, p);
    const double h = 1e-4 * at.w / std::max(map.warped.kappa, 1 / map.warped.length);
    const double across =
        1e-4 * at.w * map.warped.width; // s is linear in x, so any step is correct and a large one is the most precise
    const MapImage<Wide> image = wideImage(map);
    const auto texel = [&](const WideVec3& q) {
        const MapTexel<Wide> read = texelAt(image, q);
        return map.rectangle.transposed ? WideVec2(read.row, read.column) : WideVec2(read.column, read.row);
    };
    const auto perUnit = [&](const glm::dvec3& axis, Wide step) {
        const WideVec3 way = WideVec3(axis) * step;
        return (texel(WideVec3(p) + way) - texel(WideVec3(p) - way)) / (2 * step);
    };
    const WideVec2 perX = perUnit(alongX(map.warped.frame), across);
    const WideVec2 perZ = perUnit(map.warped.frame.z, h);
    const Wide pixel = imageBeamWidth(view.frustum, p.z, view.imageHeight);
    // The world step that preserves s and changes t by one texel: along z, with the x that cancels the shear.
    const Wide shear = -perZ.x / perX.x;
    return {
        static_cast<double>(1 / perX.x / pixel),
        static_cast<double>(1 / perZ.y / pixel),
        static_cast<double>(std::sqrt(1 + shear * shear) / perZ.y / pixel)};
}

/// A receiver in one map of a random set-up.
struct Receiver {
    ShadowMap map;
    double filterTexels = 0;
    glm::dvec3 p{0};
    glm::dvec3 normal{0};
    double cosine = 0;

    double bias() const { return receiverBias(cameraImage(map), p, normal, cosine); }
};

/// Returns the depth in the map at which the light ray through a texel intersects the receiver's plane.
inline Wide planeDepth(const Receiver& receiver, const WideVec2& texel) {
    const MapImage<Wide> image = wideImage(receiver.map);
    const WideMat4 offsetFromClip = glm::inverse(image.clipFromOffset);
    WideVec2 clip = (texel - image.texelOffset) / image.texelScale;
    if (image.logRows != 0) clip.y = -std::exp(-clip.y);
    const WideVec3 normal(receiver.normal);
    const WideVec4 plane(normal, -glm::dot(normal, WideVec3(receiver.p) - image.origin));
    const Wide atZero = glm::dot(plane, offsetFromClip * WideVec4(clip, 0, 1));
    const Wide change = glm::dot(plane, offsetFromClip[2]);
    return -atZero / change;
}

/// Returns how much nearer to the light the plane is at the centre of the farthest texel of the kernel than at `p`.
inline double largestRise(const Receiver& receiver) {
    const MapTexel<Wide> at = texelAt(wideImage(receiver.map), WideVec3(receiver.p));
    const Wide reach = std::max(1.0, receiver.filterTexels) / 2;
    Wide rise = 0;
    for (const Wide dx : {-reach, reach})
        for (const Wide dy : {-reach, reach})
            rise = std::max(rise, at.depth - planeDepth(receiver, {at.column + dx, at.row + dy}));
    return static_cast<double>(rise);
}

/// Returns how far the lookup of `p`, including the kernel, is outside the rectangle of `map`, in texels, or outside
/// its depth range, in units of 1e-9. The result is at most 0 inside, and infinite if `p` is behind the warp's centre.
inline double lookupOutside(const ShadowMap& map, double filter, const glm::dvec3& p) {
    const MapTexel<double> at = texelAt(cameraImage(map), p);
    if (!(at.w > 0)) return std::numeric_limits<double>::infinity();
    const double x = at.column;
    const double y = at.row;
    const double reach = filter / 2 + 0.5; // texels of the kernel, and rounding to texels
    const TexelRectangle& r = map.rectangle;
    const double outX = std::max(r.x - (x - reach), x + reach - (r.x + r.width));
    const double outY = std::max(r.y - (y - reach), y + reach - (r.y + r.height));
    return std::max({outX, outY, -at.depth * 1e9 - 1, (at.depth - 1) * 1e9 - 1});
}

} // namespace gnomon::shadow
