// The storage factor of a whole scheme (slices, faces and warp), as the sum over its maps.
#pragma once

#include "shadow/partition/faces.h"
#include "shadow/partition/splits.h"
#include "shadow/warp/warp.h"

#include <vector>

namespace gnomon::shadow {

/// The treatment of the near square, which no side face covers.
enum class NearFace : std::uint8_t {
    Omit,    // no map covers it, as in Lloyd et al. 2006; only for figures, because it leaves a hole
    OwnMap,  // it has its own unwarped map
    Stretch, // the side faces extend to the eye and cover it
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

/// Returns the direction that the frames of the scheme's faces follow. Faces with logarithmic rows follow their near
/// edges.
Bisector bisectorOf(const Scheme& scheme);

/// One map of a scheme, with its aliasing at unit resolutions.
struct SchemeMap {
    std::size_t slice = 0;
    Face face = Face::Whole;
    LightFit fit;
    double kappa = 0;
    Aliasing unit; // M_x and M_z with res_i = res_s = res_t = 1

    double sheared = 0; // M_t: largest aliasing along t with the shear of the texel

    double storageFactor() const { return unit.x * unit.z; }

    double shearedStorageFactor() const { return unit.x * sheared; }
};

/// Returns the maps of `scheme` in the plain orientation, slice by slice. Faces have the order top, bottom, left,
/// right, near.
std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme);

/// Returns the storage factor of the scheme: the sum over its maps.
double storageFactor(const std::vector<SchemeMap>& maps);

/// Returns the storage factor with the shear of texels. With so many texels per pixel, even a sheared step in t is at
/// most a pixel.
double shearedStorageFactor(const std::vector<SchemeMap>& maps);

} // namespace gnomon::shadow
