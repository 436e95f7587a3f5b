// The closed formulas of Lloyd et al. 2006, sections 4.1 to 4.3, for one shadow map and a light directly overhead.
#pragma once

#include "shadow/fit/view_frustum.h"

namespace gnomon::shadow {

/// Perspective aliasing along the s axis (x) and the t axis (z) of a map: the width of a texel's light beam divided by
/// the width of a pixel's image beam. At 1, texels and pixels have the same size. Above 1, texels are larger than
/// pixels and become visible.
struct Aliasing {
    double x = 0;
    double z = 0;

    double worst() const { return x > z ? x : z; }
};

/// The resolutions of image and map. For the storage factor of Lloyd et al. 2006, all of them are 1.
struct Resolution {
    double image = 1; // res_i: the image's height in pixels
    double s = 1;     // texels across the map
    double t = 1;     // texels along the map
};

// In the functions below, `nPrime` (n' in Lloyd et al. 2006) is the distance from the warp's centre of projection to
// the near plane. Infinity means an unwarped, orthogonal map. Depths are in world units.

/// Returns n'_LSPSM = n + sqrt(f n), the distance of the warp's centre that minimises M_z (Wimmer et al. 2004; their
/// paper prints z in place of n).
double nPrimeLspsm(const ViewFrustum& frustum);

/// Returns the perspective aliasing m_x and m_z at view depth `depth` (Eqs 7 and 8), for n' >= near.
Aliasing aliasingOverhead(const ViewFrustum& frustum, double nPrime, double depth, const Resolution& resolution);

/// Returns M_x and M_z, the max perspective aliasing over the whole frustum (Eqs 9 and 10), for n' >= near at unit
/// resolutions.
Aliasing worstAliasingOverhead(const ViewFrustum& frustum, double nPrime);

/// Returns the storage factor S = M_x M_z: the texels per pixel that an aliasing of 1 requires (Eq 12, with a branch
/// that the paper omits). S is constant for near <= n' <= n'_LSPSM and larger outside this range. For n' < near, S
/// grows because the map must contain both the near edge and the far edge.
double storageFactorOverhead(const ViewFrustum& frustum, double nPrime);

/// Returns the distance n' of the warp's centre for the parameter eta in [-1, 1] (Eq 11): -1 gives an orthogonal map, 0
/// gives n'_LSPSM, and 1 gives n' = near.
double nPrimeOfEta(const ViewFrustum& frustum, double eta);

/// Returns the parameter eta for the distance `nPrime` >= near of the warp's centre: the inverse of nPrimeOfEta
/// (appendix B, corrected).
double etaOfNPrime(const ViewFrustum& frustum, double nPrime);

/// Returns the distance n' of the warp's centre for a trapezoidal shadow map. This map moves the depth `focus` behind
/// the near plane to t = `fraction`, usually 0.8. Returns infinity if focus >= fraction (far - near).
double nPrimeTsm(const ViewFrustum& frustum, double focus, double fraction);

/// The map resolutions for which the aliasing is 1 (M_x = M_z = 1), and the resolutions in the same proportion for a
/// given texel budget (Eqs 13 and 14).
struct BudgetOverhead {
    double criticalS = 0;
    double criticalT = 0;
    double s = 0;
    double t = 0;
    Aliasing worst; // aliasing at the resolutions `s` and `t`
};

/// Returns the map resolutions of Eqs 13 and 14 for a budget of `texels` and an image of `imagePixels` per side. n'
/// must be at least near.
BudgetOverhead budgetOverhead(const ViewFrustum& frustum, double nPrime, double texels, double imagePixels);

} // namespace gnomon::shadow
