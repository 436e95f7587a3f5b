// Computes the depth bias of a shadow lookup, which needs no parameters from the user. The bias is the change of depth
// of the receiver's plane over the texels that the lookup reads.
#pragma once

#include "shadow/warp/warped_map.h"

namespace gnomon::shadow {

/// Max slope (tangent) between a receiver's plane and a neighbouring triangle that rises more steeply towards the
/// light. The depth bias covers this slope. A receiver is planar only within its triangle: if the next triangle rises
/// towards the light, a shared texel stores the nearer depth of that triangle and would darken the receiver. The slope
/// is limited because a larger bias leaks more light. Next to a caster that touches the receiver, light leaks over at
/// most 1.5 texel footprints. At angle theta from the normal, the leak is sin^2 theta / 2 + (slope / sqrt 2) sin theta
/// cos theta.
inline constexpr double kUnevenSlope = 3.4;

/// Min cosine between receiver normal and light for which the depth bias covers the whole slope of the receiver's
/// plane. For smaller cosines, the slope term is multiplied by cosine / kMinCosine, because the bias would otherwise
/// grow without limit.
inline constexpr double kMinCosine = 0.1;

/// Rounding error of map depths in rasterisation and lookup: ten units in the last place of a float just below 1.
inline constexpr double kDepthRounding = 6e-7;

/// Returns the max distance, in texels per axis, from the lookup point to the centre of a texel that the filter reads.
/// The filter is a square of `filterTexels` per side (0: one texel). The result includes 1/256 texel for the
/// rasteriser's subpixels.
double reachTexels(double filterTexels);

/// The change of depth of a receiver's plane over the width of one texel: along x, and along z at w = 1.
struct TexelDepth {
    double x = 0;
    double z = 0;
};

TexelDepth texelDepth(const WarpedMap& map, const Resolution& texels);

/// Returns the max depth bias over all receivers in the region of `fit`, for a map of `texels`. The unit is that of
/// rawDepth, the map's depth before scaling to [0, 1]. The depth range of the map must be extended by this bias at both
/// ends. Otherwise a caster that is clamped to depth 0 would not darken a receiver whose biased depth is below 0.
double largestRawBias(const LightFit& fit, double kappa, const Resolution& texels, double filterTexels);

} // namespace gnomon::shadow
