// Computes the storage factor of a whole shadow scheme (slices, faces and warp): the sum over its maps.
#pragma once

#include "shadow/partition/faces.h"
#include "shadow/partition/splits.h"
#include "shadow/warp/warp.h"

#include <vector>

namespace gnomon::shadow {

/// How a scheme covers the near square of the frustum, which no side face covers by itself.
enum class NearFace : std::uint8_t {
    Omit,    // no map covers it, as in Lloyd et al. 2006; only for figures, because it leaves a hole
    OwnMap,  // it has its own unwarped map
    Stretch, // the maps of the side faces extend to the eye and cover it
};

/// A shadow scheme: a combination of slices, face partitions and warp.
struct Scheme {
    Warp warp;
    int slices = 4;
    double splitLambda = 1;
    bool faces = false;
    Bisector bisector = Bisector::Normalized;
    NearFace nearFace = NearFace::OwnMap;
};

/// Returns the rule for the z axes of the face maps of `scheme`: NearEdge for logarithmic rows.
Bisector bisectorOf(const Scheme& scheme);

/// One shadow map of a scheme, with its perspective aliasing at unit resolutions.
struct SchemeMap {
    std::size_t slice = 0;
    Face face = Face::Whole;
    LightFit fit;
    double kappa = 0;
    Aliasing unit; // max perspective aliasing M_x and M_z, with res_i = res_s = res_t = 1

    double sheared = 0; // M_t: max aliasing along t, including the shear of the texel

    double storageFactor() const { return unit.x * unit.z; }

    double shearedStorageFactor() const { return unit.x * sheared; }
};

/// Returns the shadow maps of `scheme` in the plain orientation, slice by slice. The order of the faces is top, bottom,
/// left, right, near.
std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme);

/// Returns the storage factor of a scheme: the texels per pixel that an aliasing of 1 requires, summed over its maps.
double storageFactor(const std::vector<SchemeMap>& maps);

/// Returns the storage factor of a scheme, including the shear of texels. With this number of texels per pixel, a step
/// of one texel in t is at most one pixel long, even if it is sheared.
double shearedStorageFactor(const std::vector<SchemeMap>& maps);

} // namespace gnomon::shadow
