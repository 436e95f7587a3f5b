// Face partitioning: the view frustum is divided along the edges of its faces, as seen from the light. Each face has
// its own map.
#pragma once

#include "shadow/fit/light_fit.h"

#include <array>
#include <cstdint>
#include <vector>

namespace gnomon::shadow {

/// The part of a depth slice that one shadow map covers: the whole slice, the part at one face of the frustum, or a
/// face of the cube around a point light.
enum class Face : std::uint8_t { Whole, Top, Bottom, Left, Right, Near, PlusX, MinusX, PlusY, MinusY, PlusZ, MinusZ };

/// Returns the name of a face: "whole", "top", "bottom", "left", "right" or "near", or "+x", "-x", "+y", "-y", "+z" or
/// "-z" for a cube face.
const char* name(Face face);

/// The rule for the z axis of the shadow map of a frustum face. The rules use the face's two side edges, projected
/// along the light.
enum class Bisector : std::uint8_t {
    Normalized, // the bisector of the unit edge directions, which is correct
    Literal,    // e0' + e1' as the paper prints it; the longer edge has more influence
    /// The z axis is perpendicular to the face's near edge. If the centre of the warp is at the eye, the warp turns the
    /// face into a rectangle with constant m_x. The axes of the near square are sheared, because the light sees the
    /// square as a parallelogram.
    NearEdge,
};

/// Returns the outward unit normal of a side face or of the near face of `frustum`.
glm::dvec3 outwardNormal(const ViewFrustum& frustum, Face face);

/// Returns the side faces of the frustum that need shadow maps, in the order top, bottom, left, right. On each light
/// ray, these faces contain the point where a pixel is narrowest. If the light is behind the viewer (L.v <= 0), these
/// are the faces towards the light, otherwise the faces away from the light. A face is omitted if the sine of its angle
/// to the light is at most `grazing`.
std::vector<Face> sideFaces(const ViewFrustum& frustum, const glm::dvec3& towardsLight, double grazing = 1e-12);

/// Returns the four corners of a side face of `slice` (near, near, far, far), or of its near face.
std::array<FitVertex, 4> faceVertices(const ViewFrustum& slice, Face face);

/// Returns the light-space axes for the shadow map of `face`. z follows the bisector of the face's side edges. The near
/// face has the plain orientation. With Bisector::NearEdge, z is perpendicular to the near edge and points away from
/// the eye. The axes of the near face are then sheared (lean), so that the face is a rectangle in (x, z).
LightFrame faceFrame(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

/// Computes the light-space region that the shadow map of `face` covers, from the four corners of the face. Seen along
/// the light, these corners cover the whole part of the view that uses this map.
LightFit fitFace(const ViewFrustum& slice, const glm::dvec3& towardsLight, Face face, Bisector bisector);

} // namespace gnomon::shadow
