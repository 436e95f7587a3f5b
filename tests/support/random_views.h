// Seeded random frusta, lights and schemes for tests of the shadow theory, with many difficult cases. A source of
// random numbers is Random or a search over numbers (tests/torture/genes.h).
#pragma once

#include "core/angle.h"
#include "core/random.h"
#include "shadow/setup.h"

#include <array>
#include <cmath>

namespace gnomon::shadow {

template <class Source>
glm::dvec3 randomDirection(Source& random) {
    const double z = random.uniform(-1, 1);
    const double angle = random.uniform(0, 2 * kPi);
    const double radius = std::sqrt(std::max(0.0, 1 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Returns a direction at `angle` radians from `axis`, with a random azimuth.
template <class Source>
glm::dvec3 directionNear(Source& random, const glm::dvec3& axis, double angle) {
    glm::dvec3 across = glm::cross(axis, randomDirection(random));
    if (across == glm::dvec3(0)) across = glm::cross(axis, glm::dvec3(axis.y, axis.z, axis.x));
    across = glm::normalize(across);
    return glm::normalize(axis * std::cos(angle) + across * std::sin(angle));
}

/// Returns a uniform direction in two of three cases. Otherwise returns a direction exactly or almost along an axis of
/// the camera.
template <class Source>
glm::dvec3 randomLight(Source& random) {
    if (random.below(3) != 0) return randomDirection(random);
    const std::array<glm::dvec3, 6> axes{{{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}}};
    const glm::dvec3 axis = axes[random.below(axes.size())];
    const std::array<double, 5> angles{0, 1e-12, 1e-9, 1e-6, 1e-3};
    const double angle = angles[random.below(angles.size())];
    return angle == 0 ? axis : directionNear(random, axis, angle);
}

/// Returns a frustum with a depth ratio from 1.2 to 1e6, a half angle from 5 to 70 degrees, and an image from portrait
/// to panorama.
template <class Source>
ViewFrustum randomFrustum(Source& random) {
    ViewFrustum frustum;
    frustum.near = std::pow(10.0, random.uniform(-2, 1));
    frustum.far = frustum.near * std::pow(10.0, random.uniform(0.08, 6));
    frustum.halfFovYRadians = random.uniform(5, 70) * kPi / 180;
    frustum.aspect = std::array<double, 4>{1.0, 0.5, 1.5, 3.0}[random.below(4)];
    return frustum;
}

/// Returns a point of the frustum, uniform in depth or in its logarithm, and sometimes exactly on a side or in a
/// corner.
template <class Source>
glm::dvec3 randomPointIn(Source& random, const ViewFrustum& frustum) {
    const double part = random.unit();
    const double depth = random.below(2) == 0 ? frustum.near + (frustum.far - frustum.near) * part
                                              : frustum.near * std::pow(frustum.depthRatio(), part);
    const auto across = [&] {
        const std::uint64_t kind = random.below(20);
        return kind == 0 ? 1.0 : kind == 1 ? -1.0 : kind == 2 ? 0.0 : random.uniform(-1, 1);
    };
    const double x = across() * tanHalfX(frustum);
    const double y = across() * tanHalfY(frustum);
    return {x * depth, y * depth, depth};
}

/// Returns the position (column, row) of `p` in the depth texture, computed from (s, t) alone.
inline glm::dvec2 exactTexel(const ShadowMap& map, const glm::dvec3& p) {
    const MapPoint at = mapPoint(map.warped, p);
    const TexelRectangle inner = map.innerRectangle();
    const double along = inner.transposed ? at.t : at.s;
    const double up = inner.transposed ? at.s : at.t;
    return {inner.x + along * inner.width, inner.y + up * inner.height};
}

template <class Source>
Warp randomWarp(Source& random, const ViewFrustum& frustum) {
    Warp warp;
    warp.rule = std::array<WarpRule, 9>{
        WarpRule::None,
        WarpRule::Psm,
        WarpRule::Lspsm,
        WarpRule::Tsm,
        WarpRule::Minimax,
        WarpRule::Auto,
        WarpRule::Eta,
        WarpRule::Given,
        WarpRule::Log}[random.below(9)];
    warp.eta = random.uniform(-1, 1);
    warp.tsmFocus = (frustum.far - frustum.near) * random.uniform(0.001, 1);
    warp.kappa = random.uniform(0, 2) / frustum.near;
    return warp;
}

template <class Source>
ShadowOptions randomOptions(Source& random, const ViewFrustum& frustum) {
    ShadowOptions options;
    options.scheme.warp = randomWarp(random, frustum);
    options.scheme.slices = 1 + static_cast<int>(random.below(8));
    options.scheme.splitLambda = random.below(2) == 0 ? 1 : random.unit();
    options.scheme.faces = random.below(2) == 0;
    options.scheme.nearFace = random.below(2) == 0 ? NearFace::OwnMap : NearFace::Stretch;
    options.scheme.bisector = random.below(4) == 0 ? Bisector::Literal : Bisector::Normalized;
    options.chosenOrientation = random.below(2) == 0;
    options.stabilized = random.below(6) == 0;
    options.filterTexels = static_cast<double>(random.below(4));
    options.texels = std::uint64_t{1} << (16 + random.below(9));
    return options;
}

/// Returns a depth range that exceeds one end or both ends of `frustum` by a factor of up to ten.
template <class Source>
DepthSpan shownOutside(Source& random, const ViewFrustum& frustum) {
    const std::uint64_t ends = 1 + random.below(3);
    const double nearer = (ends & 1U) != 0 ? std::pow(10.0, random.unit()) : 1;
    const double further = (ends & 2U) != 0 ? std::pow(10.0, random.unit()) : 1;
    return {frustum.near / nearer, frustum.far * further};
}

template <class Source>
ShadowView randomView(Source& random) {
    ShadowView view;
    view.frustum = randomFrustum(random);
    view.towardsLight = randomLight(random);
    view.imageHeight = 100 + static_cast<int>(random.below(2000));
    Camera camera;
    camera.eye = randomDirection(random) * std::pow(10.0, random.uniform(0, 7));
    camera.target = camera.eye + randomDirection(random);
    view.anchor = {cameraBasis(camera), camera.eye};
    return view;
}

} // namespace gnomon::shadow
