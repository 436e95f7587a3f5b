// Face partitioning: the frustum cut along the edges of its faces as the light sees them, so that each face gets a map.
#pragma once

#include "shadow/fit/light_fit.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::shadow {

/// A face of a slice, or the whole of it where it is not cut along its faces; or one of a cube about a point light.
enum class Face : std::uint8_t { Whole, Top, Bottom, Left, Right, Near, PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// "whole", "top", "bottom", "left", "right" or "near"; "+x", "-x", "+y", "-y", "+z" or "-z".
const char* name(Face face);

/// Which bisector of a face's two side edges, projected along the light, the map's z axis follows.
enum class Bisector : std::uint8_t {
    Normalized, // of the edges' directions: the right one
    Literal,    // e0' + e1' as the paper prints it, which the longer edge pulls to itself
    NearEdge,   // of neither: across the face's near edge, so that with its centre at the eye a warp makes the face a
                // rectangle on which m_x is constant; the near square's map is as oblique as the light sees the square
};

/// The outward unit normal of a side face or of the near face.
glm::dvec3 outwardNormal(const ViewFrustum& frustum, Face face);

/// The side faces that bear maps, in the order top, bottom, left, right: those that the narrowest image beams along
/// each light ray meet, turned to the light where it is behind the viewer (L.v <= 0) and away from it where it is in
/// front. A face counts where the sine of its angle to the light is above `grazing`.
std::vector<Face> sideFaces(const ViewFrustum& frustum, const glm::dvec3& towardsLight, double grazing = 1e-12);

/// The four corners of a side face of `slice` (near, near, far, far), or of its near face.
std::array<FitVertex, 4> faceVertices(const ViewFrustum& slice, Face face);

/// The light frame of a face's map: z along the bisector of its side edges; the near face takes the plain convention.
/// By its near edge, z is across that, and away from the eye. The near face's frame then leans, so that the face is a
/// rectangle in (x, z).
LightFrame faceFrame(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

/// A face's region as its map sees it: its four corners, whose projection along the light is that of its partition.
LightFit fitFace(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

} // namespace gnomon::shadow
