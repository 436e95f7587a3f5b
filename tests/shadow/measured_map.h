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
    const DoubleMapImage image = cameraImage(map);
    const auto texel = [&](const glm::dvec3& q) {
        const MapTexel<double> read = texelAt(image, q);
        return map.rectangle.transposed ? glm::dvec2(read.row, read.column) : glm::dvec2(read.column, read.row);
    };
    const glm::dvec3 x = alongX(map.warped.frame);
    const glm::dvec2 perX = (texel(p + x * across) - texel(p - x * across)) / (2 * across);
    const glm::dvec2 perZ = (texel(p + map.warped.frame.z * h) - texel(p - map.warped.frame.z * h)) / (2 * h);
    const double pixel = imageBeamWidth(view.frustum, p.z, view.imageHeight);
    // The world step that keeps s and moves t by a texel: z with as much x as undoes its shear.
    const double shear = -perZ.x / perX.x;
    return {1 / perX.x / pixel, 1 / perZ.y / pixel, std::sqrt(1 + shear * shear) / perZ.y / pixel};
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
inline double planeDepth(const Receiver& receiver, const glm::dvec2& texel) {
    const DoubleMapImage image = cameraImage(receiver.map);
    const glm::dmat4 offsetFromClip = glm::inverse(image.clipFromOffset);
    glm::dvec2 clip = (texel - image.texelOffset) / image.texelScale;
    if (image.logRows != 0) clip.y = -std::exp(-clip.y);
    const glm::dvec4 plane(receiver.normal, -glm::dot(receiver.normal, receiver.p - image.origin));
    const double atZero = glm::dot(plane, offsetFromClip * glm::dvec4(clip, 0, 1));
    const double change = glm::dot(plane, offsetFromClip[2]);
    return -atZero / change;
}

/// How much nearer to the light than at `p` the plane is at the middle of the furthest texel that a kernel reads.
inline double largestRise(const Receiver& receiver) {
    const MapTexel<double> at = texelAt(cameraImage(receiver.map), receiver.p);
    const double reach = std::max(1.0, receiver.filterTexels) / 2;
    double rise = 0;
    for (const double dx : {-reach, reach})
        for (const double dy : {-reach, reach})
            rise = std::max(rise, at.depth - planeDepth(receiver, {at.column + dx, at.row + dy}));
    return rise;
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
