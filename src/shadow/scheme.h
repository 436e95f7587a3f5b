// The storage factor of a whole scheme (slices, faces and warp): the sum over its maps.
#pragma once

#include "shadow/partition/faces.h"
#include "shadow/partition/splits.h"
#include "shadow/warp/warp.h"

#include <vector>

namespace gnomon::shadow {

/// The treatment of the near square, which no side face covers by itself.
enum class NearFace : std::uint8_t {
    Omit,    // no map covers it, as in Lloyd et al. 2006; only for figures, because it leaves a hole
    OwnMap,  // it has its own unwarped map
    Stretch, // the maps of the side faces extend to the eye and cover it
};

/// A scheme: a combination of slices, face partitions and warp.
struct Scheme {
    Warp warp;
    int slices = 4;
    double splitLambda = 1;
    bool faces = false;
    Bisector bisector = Bisector::Normalized;
    NearFace nearFace = NearFace::OwnMap;
};

/// Returns the rule for the z axes of the scheme's face maps: NearEdge for logarithmic rows.
Bisector bisectorOf(const Scheme& scheme);

/// One map of a scheme, with its aliasing at unit resolutions.
struct SchemeMap {
    std::size_t slice = 0;
    Face face = Face::Whole;
    LightFit fit;
    double kappa = 0;
    Aliasing unit; // M_x and M_z with res_i = res_s = res_t = 1

    double sheared = 0; // M_t: max aliasing along t, including the shear of the texel

    double storageFactor() const { return unit.x * unit.z; }

    double shearedStorageFactor() const { return unit.x * sheared; }
};

/// Returns the maps of `scheme` in the plain orientation, slice by slice. The order of the faces is top, bottom, left,
/// right, near.
std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme);

/// Returns the storage factor of the scheme: the sum over its maps.
double storageFactor(const std::vector<SchemeMap>& maps);

/// Returns the storage factor with the shear of texels. With this number of texels per pixel, a step of one texel in t
/// is at most one pixel long, even if it is sheared.
double shearedStorageFactor(const std::vector<SchemeMap>& maps);

} // namespace gnomon::shadow
