// The depth bias of a lookup, without a knob: what the receiver's own plane changes by over the texels that are read.
#pragma once

#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// How much steeper than the receiver its neighbour within a texel may rise towards the light, as a tangent. A receiver
/// is one plane only as far as its triangle goes: where the next one rises towards the light, the texel that both share
/// holds what is nearer, and would darken the other. As large as lets the light in under a caster that touches the
/// receiver by at most 1.5 of the texel's footprints: at theta from the normal the gap is
/// sin^2 theta / 2 + (slope / sqrt 2) sin theta cos theta.
inline constexpr double kUnevenSlope = 3.4;

/// The cosine of receiver normal and light from which on the bias is all that the receiver's plane asks for. Below, the
/// slope counts in proportion to the cosine, or a grazing receiver would ask for any bias.
inline constexpr double kLeastCosine = 0.1;

/// Ten units in the last place of a float depth just under 1: what rasterising and looking up round.
inline constexpr double kDepthRounding = 6e-7;

/// How far from the point that is looked up the middle of a texel lies that a square kernel of `filterTexels` (0: a
/// single texel) reads, in texels along each axis, with 1/256 for the rasteriser's subpixels.
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

} // namespace gnomon::shadow
