// The closed forms of Lloyd et al. 2006, sections 4.1 to 4.3, for one map and a light straight overhead.
#pragma once

#include "shadow/fit/view_frustum.h"

namespace gnomon::shadow {

/// Perspective aliasing along the map's s axis (x) and t axis (z): the width of a texel's light beam over the width of
/// a pixel's image beam. 1 is neither too coarse nor too fine; above 1 the texels show.
struct Aliasing {
    double x = 0;
    double z = 0;

    double worst() const { return x > z ? x : z; }
};

/// What the resolutions of image and map are; the paper's storage factor takes all of them as 1.
struct Resolution {
    double image = 1; // res_i: the image's height in pixels
    double s = 1;     // texels across the map
    double t = 1;     // texels along the map
};

// In all of these `nPrime` (n' of the paper) is the distance of the near plane from the warp's centre of projection;
// infinity is the unwarped, orthogonal map. Depths in world units.

/// n'_LSPSM = n + sqrt(f n), where M_z is least (the paper's text has z for n; Wimmer et al. 2004).
double nPrimeLspsm(const ViewFrustum& frustum);

/// m_x and m_z at view depth `depth` (Eqs 7 and 8), for n' >= near.
Aliasing aliasingOverhead(const ViewFrustum& frustum, double nPrime, double depth, const Resolution& resolution);

/// M_x and M_z over the whole frustum (Eqs 9 and 10), for n' >= near at unit resolutions.
Aliasing worstAliasingOverhead(const ViewFrustum& frustum, double nPrime);

/// The storage factor S = M_x M_z (Eq 12 with its missing branch): constant for near <= n' <= n'_LSPSM, larger beyond
/// it, and larger for n' < near, where both the near and the far edge have to fit.
double storageFactorOverhead(const ViewFrustum& frustum, double nPrime);

/// n' of the parameter eta in [-1, 1] (Eq 11): -1 is orthogonal, 0 is n'_LSPSM, 1 is n' = near.
double nPrimeOfEta(const ViewFrustum& frustum, double eta);

/// The inverse of nPrimeOfEta (appendix B, corrected), for n' >= near.
double etaOfNPrime(const ViewFrustum& frustum, double nPrime);

/// n' that maps the depth `focus` behind the near plane to t = `fraction` (trapezoidal shadow maps: 0.8);
/// infinity from focus = fraction (far - near) on.
double nPrimeTsm(const ViewFrustum& frustum, double focus, double fraction);

/// Resolutions at which M_x = M_z = 1, and the share of a texel budget in the same proportion (Eqs 13 and 14).
struct BudgetOverhead {
    double criticalS = 0;
    double criticalT = 0;
    double s = 0;
    double t = 0;
    Aliasing worst; // with the resolutions `s` and `t`
};

/// Eqs 13 and 14 for a budget of `texels` and an image of `imagePixels` a side, n' >= near.
BudgetOverhead budgetOverhead(const ViewFrustum& frustum, double nPrime, double texels, double imagePixels);

} // namespace gnomon::shadow
