// The depth bias of a lookup, without a knob: what the receiver's own plane changes by over the texels that are read.
#pragma once

#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// What a shader needs, per map, to bias its lookups. With the receiver's plane (N, -N.p), N the flat geometric normal
/// of unit length: P = planeOfTexture * plane; the depth slopes are -P.x / P.z along s and -P.y / P.z along t; the bias
/// to subtract from the receiver's depth is |slope s| reachS + |slope t| reachT + unevenness + rounding. A receiver is
/// one plane only as far as its triangle goes: where the next one rises towards the light, the texel that both share
/// holds what is nearer, and would darken the other. So the bias also holds what kUnevenSlope changes over the reach.
struct DepthBias {
    glm::dmat4 textureFromCameraPlane{1}; // the inverse transpose of textureFromCamera
    double reachS = 0;                    // (1/2 + kernel radius + 1/256) texel, as a fraction of the texture
    double reachT = 0;
    double unevenX = 0;   // depth that kUnevenSlope changes over the reach along x
    double unevenZ = 0;   // and along z where w is 1: times w; the unevenness is the length of both
    glm::dvec4 wPlane{0}; // w of a point (p, 1) is its product with this
    double rounding = 0;  // a few units in the last place of a float depth
    double leastCosine =
        0.1; // below this N.L the normal is taken as tilted back to it; at or below 0 it is dark unasked
};

/// How much steeper than the receiver its neighbour within a texel may rise towards the light, as a tangent. As large
/// as lets the light in under a caster that touches the receiver by at most 1.5 of the texel's footprints: at theta
/// from the normal the gap is sin^2 theta / 2 + (slope / sqrt 2) sin theta cos theta.
inline constexpr double kUnevenSlope = 3.4;

/// The reach of a lookup with a kernel of `filterTexels` (0: a single texel) in texels.
double reachTexels(double filterTexels);

/// Depth of `map` over the width of one of `texels`: along x, and along z where w is 1.
struct TexelDepth {
    double x = 0;
    double z = 0;
};

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels);

/// The largest bias, in rawDepth, that any receiver of the region can ask for with `texels` on each side: the depth
/// range has to grow by it at both ends, or a clamped caster at 0 lights a receiver biased below 0.
double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels);

/// The bias of a receiver at `p` with unit normal `normal`, in depth of the map, as the shader computes it.
double depthBias(const DepthBias& bias, const LightFrame& frame, const glm::dvec3& p, const glm::dvec3& normal);

/// The bias data of a map whose texture matrix is `textureFromCamera`, in a texture of `width` x `height` texels;
/// `texel` is the map's texelDepth.
DepthBias depthBiasOf(
    const glm::dmat4& textureFromCamera, int width, int height, const TexelDepth& texel, double filterTexels);

} // namespace gnomon::shadow
