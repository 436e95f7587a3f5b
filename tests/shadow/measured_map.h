// What a shadow map does at a point, measured beside what it promises: its aliasing by finite differences, the rise of
// the receiver's own plane over what a kernel reads, and whether a lookup stays in the map.
#pragma once

#include "shadow/depth_bias.h"
#include "shadow/map_image.h"
#include "shadow/setup.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

/// What is measured, by a wider number than what it is measured of: next to a warp's centre of projection numbers
/// cancel, and in doubles the differences below would tell the measure's own rounding.
using Wide = long double;
using WideVec2 = glm::vec<2, Wide, glm::defaultp>;
using WideVec3 = glm::vec<3, Wide, glm::defaultp>;
using WideVec4 = glm::vec<4, Wide, glm::defaultp>;
using WideMat4 = glm::mat<4, 4, Wide, glm::defaultp>;

/// The image of a map, as far as a place in it is told.
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

/// The aliasing that a map has at a point.
struct Measured {
    double x = 0;
    double z = 0;
    double sheared = 0;
};

/// The aliasing at `p` by finite differences of the matrix that textures are looked up with, in real texels and pixels.
inline Measured measuredAt(const ShadowMap& map, const ShadowView& view, const glm::dvec3& p) {
    const MapPoint at = mapPoint(map.warped, p);
    const double h = 1e-4 * at.w / std::max(map.warped.kappa, 1 / map.warped.length);
    const double across =
        1e-4 * at.w * map.warped.width; // s goes evenly with x: any step will do, and a large one best
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
    // The world step that keeps s and moves t by a texel: z with as much x as undoes its shear.
    const Wide shear = -perZ.x / perX.x;
    return {
        static_cast<double>(1 / perX.x / pixel),
        static_cast<double>(1 / perZ.y / pixel),
        static_cast<double>(std::sqrt(1 + shear * shear) / perZ.y / pixel)};
}

/// A receiver in one map of a random setup.
struct Receiver {
    ShadowMap map;
    double filterTexels = 0;
    glm::dvec3 p{0};
    glm::dvec3 normal{0};
    double cosine = 0;

    double bias() const { return receiverBias(cameraImage(map), p, normal, cosine); }
};

/// The depth in the map of the receiver's plane where the light's ray through a place of the texture meets it.
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

/// How much nearer to the light than at `p` the plane is at the middle of the furthest texel that a kernel reads.
inline double largestRise(const Receiver& receiver) {
    const MapTexel<Wide> at = texelAt(wideImage(receiver.map), WideVec3(receiver.p));
    const Wide reach = std::max(1.0, receiver.filterTexels) / 2;
    Wide rise = 0;
    for (const Wide dx : {-reach, reach})
        for (const Wide dy : {-reach, reach})
            rise = std::max(rise, at.depth - planeDepth(receiver, {at.column + dx, at.row + dy}));
    return static_cast<double>(rise);
}

/// How far the lookup of `p`, kernel included, lies outside of the rectangle of `map`, in texels, or outside of its
/// depths, in 1e-9 of those; at most 0 where it lies inside. Infinite where `p` is behind the warp's centre.
inline double lookupOutside(const ShadowMap& map, double filter, const glm::dvec3& p) {
    const MapTexel<double> at = texelAt(cameraImage(map), p);
    if (!(at.w > 0)) return std::numeric_limits<double>::infinity();
    const double x = at.column;
    const double y = at.row;
    const double reach = filter / 2 + 0.5; // the kernel's texels and the rounding to them
    const TexelRectangle& r = map.rectangle;
    const double outX = std::max(r.x - (x - reach), x + reach - (r.x + r.width));
    const double outY = std::max(r.y - (y - reach), y + reach - (r.y + r.height));
    return std::max({outX, outY, -at.depth * 1e9 - 1, (at.depth - 1) * 1e9 - 1});
}

} // namespace gnomon::shadow
