// The depth bias of a shadow lookup, without a parameter to tune. The bias is the change of the receiver plane's depth
// over the texels that the lookup reads.
#pragma once

#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// Max slope, as a tangent, by which a neighbouring surface may rise towards the light more steeply than the receiver.
/// A receiver is planar only within its triangle. If the next triangle rises towards the light, the shared texel stores
/// its nearer depth and would darken the receiver. The value limits light leaking: below a caster that touches the
/// receiver, light enters over at most 1.5 texel footprints. At angle theta from the normal, the gap is sin^2 theta / 2
/// + (slope / sqrt 2) sin theta cos theta.
inline constexpr double kUnevenSlope = 3.4;

/// The smallest cosine between receiver normal and light that gets the full bias of the receiver's plane. Below this
/// value the slope term is scaled by the cosine, because the bias would otherwise grow without limit.
inline constexpr double kMinCosine = 0.1;

/// Ten units in the last place of a float depth just below 1: the rounding error of rasterisation and lookup.
inline constexpr double kDepthRounding = 6e-7;

/// Returns the max distance from the lookup point to the centre of a texel that the filter reads, in texels per axis.
/// The filter is a square of `filterTexels` (0: one texel). The result includes 1/256 texel for the rasteriser's
/// subpixels.
double reachTexels(double filterTexels);

/// The change of depth over the width of one texel: along x, and along z at w = 1.
struct TexelDepth {
    double x = 0;
    double z = 0;
};

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels);

/// Returns the largest bias, in rawDepth, of all receivers in the region, for a map of `texels`. The depth range of the
/// map must grow by this amount at both ends. Otherwise a caster that is clamped to depth 0 does not darken a receiver
/// with a biased depth below 0.
double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels);

} // namespace gnomon::shadow
