// Face partitioning: the frustum is cut along the edges of its faces, seen from the light, and each face gets its own
// map.
#pragma once

#include "shadow/fit/light_fit.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::shadow {

/// A face of a slice, a whole slice without face partitions, or a face of the cube around a point light.
enum class Face : std::uint8_t { Whole, Top, Bottom, Left, Right, Near, PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// Returns "whole", "top", "bottom", "left", "right" or "near"; "+x", "-x", "+y", "-y", "+z" or "-z".
const char* name(Face face);

/// The direction of the map's z axis, from a face's two side edges projected along the light.
enum class Bisector : std::uint8_t {
    Normalized, // bisector of the unit edge directions: the correct one
    Literal,    // e0' + e1' as the paper prints it; the longer edge dominates
    /// Perpendicular to the face's near edge. With its centre at the eye, a warp turns the face into a rectangle with
    /// constant m_x. The frame of the near square is as oblique as the square seen from the light.
    NearEdge,
};

/// Returns the outward unit normal of a side face or of the near face.
glm::dvec3 outwardNormal(const ViewFrustum& frustum, Face face);

/// Returns the side faces that need maps, in the order top, bottom, left, right. These faces contain the narrowest
/// image beam along each light ray. If the light is behind the viewer (L.v <= 0), they are the faces towards the light;
/// otherwise the faces away from the light. The function omits a face if the sine of its angle to the light is at most
/// `grazing`.
std::vector<Face> sideFaces(const ViewFrustum& frustum, const glm::dvec3& towardsLight, double grazing = 1e-12);

/// Returns the four corners of a side face of `slice` (near, near, far, far), or of its near face.
std::array<FitVertex, 4> faceVertices(const ViewFrustum& slice, Face face);

/// Returns the light frame of a face's map. z follows the bisector of the face's side edges; the near face uses the
/// plain convention. With Bisector::NearEdge, z is perpendicular to the near edge and points away from the eye. The
/// frame of the near face then has a lean, so that the face is a rectangle in (x, z).
LightFrame faceFrame(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

/// Fits the map of a face to the four corners of the face. Their projection along the light is the projection of the
/// whole partition.
LightFit fitFace(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

} // namespace gnomon::shadow
