// The storage factor of a whole scheme: slices, faces and warp together, summed map by map.
#pragma once

#include "shadow/partition/faces.h"
#include "shadow/partition/splits.h"
#include "shadow/warp/warp.h"

#include <vector>

namespace gnomon::shadow {

/// What becomes of the near square, which no side face covers.
enum class NearFace : std::uint8_t {
    Omit,    // it is left out, as in the paper: a hole, for the figures only
    OwnMap,  // an unwarped map of its own
    Stretch, // the sides are stretched to the eye to cover it
};

/// A scheme of maps.
struct Scheme {
    Warp warp;
    int slices = 4;
    double splitLambda = 1;
    bool faces = false;
    Bisector bisector = Bisector::Normalized;
    NearFace nearFace = NearFace::OwnMap;
};

/// Which direction the frames of its faces follow: faces with logarithmic rows follow their near edges.
Bisector bisectorOf(const Scheme& scheme);

/// One map of a scheme with what it costs at unit resolutions.
struct SchemeMap {
    std::size_t slice = 0;
    Face face = Face::Whole;
    LightFit fit;
    double kappa = 0;
    Aliasing unit; // M_x and M_z with res_i = res_s = res_t = 1

    double sheared = 0; // M_t with the shear of the texel

    double storageFactor() const { return unit.x * unit.z; }

    double shearedStorageFactor() const { return unit.x * sheared; }
};

/// The maps of `scheme` in the plain orientation, slice by slice; faces in the order top, bottom, left, right, near.
std::vector<SchemeMap> schemeMaps(const ViewFrustum& frustum, const glm::dvec3& towardsLight, const Scheme& scheme);

/// The storage factor of the scheme: the sum over its maps.
double storageFactor(const std::vector<SchemeMap>& maps);

/// The same with the shear of texels counted: what keeps even a sheared step in t within a pixel.
double shearedStorageFactor(const std::vector<SchemeMap>& maps);

} // namespace gnomon::shadow
