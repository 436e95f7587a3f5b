// The closed forms of src/shadow with 200 bits, written as in the theory. If there is a definition (a maximum over
// vertices, a root of two equations), the code uses the definition and not the formula of src/shadow.
#pragma once

#include "tests/support/real.h"

#include <array>
#include <optional>
#include <vector>

namespace gnomon::theory::exact {

struct Vector {
    Real x, y, z;
};

struct Frustum {
    Real n, f, theta;
    Real aspect = 1;
};

struct Pair {
    Real x, z;
};

// One map with the light overhead (Lloyd et al. 2006, 4.1 to 4.3). n' may be infinite.
Real imageBeamWidth(const Frustum& v, const Real& depth, const Real& pixels);
Real nPrimeLspsm(const Frustum& v);
Pair aliasingOverhead(const Frustum& v, const Real& nPrime, const Real& depth);
Pair worstOverhead(const Frustum& v, const Real& nPrime);
Real storageOverhead(const Frustum& v, const Real& nPrime);
Real nPrimeOfEta(const Frustum& v, const Real& eta);
Real etaOfNPrime(const Frustum& v, const Real& nPrime);
Real nPrimeTsm(const Frustum& v, const Real& focus, const Real& fraction);

// Slices.
Real sliceRatio(const Real& n, const Real& f, int count);
Real split(const Real& n, const Real& f, int count, int index, const Real& lambda);
std::array<Real, 7> closedForms(const Frustum& v, int count); // in the order of shadow::ClosedForms

/// Returns the longest diagonal of a slice: the diagonal of its far rectangle, or from a near corner to the opposite
/// far corner.
Real stableExtent(const Frustum& v);

// Any light direction.
struct Frame {
    Vector x, y, z;
};

enum class Side { Top, Bottom, Left, Right, Near };
inline constexpr std::array kSides{Side::Top, Side::Bottom, Side::Left, Side::Right};

Real sinLightAngle(const Vector& light);
Frame plainFrame(const Vector& light);
Vector outward(const Frustum& v, Side side);
bool bearsMap(const Frustum& v, const Vector& light, Side side);
Real logStorage(const Frustum& v, const Vector& light);
Real logShearedStorage(const Frustum& v, const Vector& light);

struct Point {
    Real x, y, zeta, depth;
    bool isNear;
};

/// The vertices of a slice, or of one of its faces, in light space.
struct Fit {
    Frustum slice;
    Frame frame;
    std::vector<Point> points;
    Real zMin, d;
    bool hasLogRows = false;
};

Fit fitSlice(const Frustum& v, const Vector& light);
Fit fitFace(const Frustum& v, const Vector& light, Side side, bool isNormalized);

/// The measures of a map with the warp `kappa` over its fit.
struct Measures {
    Real width, mx, mz, sheared;
};

Measures measures(const Fit& fit, const Real& kappa);
Real kappaLspsm(const Fit& fit);
Real kappaTsm(const Fit& fit, const Real& focusZeta, const Real& fraction);
Real kappaMinimax(const Fit& fit);

/// Returns the minimax kappa for a slice from `near` to `far` in zeta.
Real kappaMinimax(const Real& near, const Real& far, const Real& d, const Real& depthRatio);

/// Returns the min S for kappa from 0 to `max`, where S is unimodal. Without `max`, returns the min for all kappa.
Real minStorage(const Fit& fit, const std::optional<Real>& max);

/// The map of a fit, with the names of shadow::WarpedMap.
struct Map {
    Frame frame;
    Real kappa, zMin, length, uMin, width, rawMin, rawRange;
    bool hasLogRows = false;
};

Map mapOf(const Fit& fit, const Real& kappa);

/// Returns s, t, depth, and the widths of a texel's beam along x, along z, and along t with its shear.
std::array<Real, 6> pointOf(const Map& map, const Vector& p);

/// Returns the same value as shadow::largestRawBias for `texels` texels per side.
Real largestRawBias(const Fit& fit, const Real& kappa, const Real& texels, const Real& filterTexels);

} // namespace gnomon::theory::exact
