// The shadow oracle: which points the light reaches, by exact rays, and how far a picture's shadows are from that.
#pragma once

#include "raycast/scene.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::raycast {

/// What the image shows at one pixel, relative to the eye.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 normal{0}; // geometric, unit length, towards the eye; zero where the pixel shows nothing
    float offset = 0;    // how far from the surface the ray may begin, world units: the stored error, say
};

/// A pixel of the reference.
enum class Light : std::uint8_t {
    Nothing, // the pixel shows no surface
    Turned,  // the surface is turned from the light: dark without asking anyone
    Dark,    // something is in the way
    Lit
};

/// Where light comes from: a direction, or a point, in which rays end.
struct LightSource {
    glm::vec3 at{0, 1, 0}; // of a direction that, of unit length
    bool isPoint = false;

    /// The direction from `position` to the light, of unit length.
    glm::vec3 from(const glm::vec3& position) const { return isPoint ? glm::normalize(at - position) : at; }

    /// How far from `position` that is.
    float distance(const glm::vec3& position) const {
        return isPoint ? glm::length(at - position) : std::numeric_limits<float>::infinity();
    }
};

/// Whether the light reaches one point.
Light litByRay(const Occluders& scene, const SurfacePoint& point, const LightSource& source);

/// What the light reaches, point by point, on all cores.
std::vector<Light> litByRays(const Occluders& scene, std::span<const SurfacePoint> points, const LightSource& source);

/// How far a picture's shadows are from the reference, over its lit-side pixels: those that show a surface turned
/// towards the light.
struct ShadowComparison {
    std::uint64_t litSidePixels = 0;
    std::uint64_t wrongPixels = 0;
    std::uint64_t edgePixels = 0;      // of both pictures, whose distances are in the figures below
    std::uint64_t edgePixelsApart = 0; // of the reference alone, which are not
    double wrongFraction = 0;          // of the lit-side pixels; 0 if there are none
    double edgeMedianPixels = 0;       // from each shadow edge of either picture to the nearest of the other
    double edgeP99Pixels = 0;
    double edgeWorstPixels = 0;
    double worstWrongPixels = 0;       // the furthest wrong pixel from an edge of the reference
    std::vector<float> wrongDistances; // per pixel: 0 if right, else the distance from the reference's nearest edge
};

/// The pixels of a picture of `width` columns that have a lit-side neighbour (of four) with another answer: 1, else 0.
std::vector<std::uint8_t> shadowEdges(std::span<const Light> reference, std::size_t width);

/// Compares two pictures of `width` columns. `isLit` is the picture's answer where the reference is Dark or Lit. An
/// edge is a pixel that has a lit-side neighbour (of four) with another answer; distances are between pixel centres,
/// and the picture's diagonal where the other has no edge at all. `apart` (a mark a pixel, or nothing) names what the
/// picture need not show: between a pixel of it and another the reference's edge is not held against the picture, and a
/// dark one of it that the picture has lit is not wrong. An edge that the picture shows is still near to it.
ShadowComparison compareShadows(
    std::span<const Light> reference,
    std::span<const std::uint8_t> isLit,
    std::size_t width,
    std::span<const std::uint8_t> apart = {});

/// The exact Euclidean distance of each pixel centre from the nearest marked one (Felzenszwalb and Huttenlocher 2012);
/// the picture's diagonal if none is marked.
std::vector<float> distanceTransform(std::span<const std::uint8_t> marked, std::size_t width);

} // namespace gnomon::raycast
