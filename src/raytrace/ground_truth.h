// Computes with rays which visible points are lit (the ground truth), and measures how far the shadows of a picture
// differ.
#pragma once

#include "raytrace/scene.h"

#include <glm/geometric.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace gnomon::raytrace {

/// The visible surface at one pixel, in coordinates relative to the eye.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 normal{0}; // geometric, unit length, towards the eye; zero without a surface
    /// Max offset of the shadow ray's origin from the surface, in world units, for example the stored error of the
    /// surface.
    float offset = 0;
};

/// The ground truth of a pixel: whether the light reaches its visible surface.
enum class Light : std::uint8_t {
    Nothing, // no surface is visible
    Turned,  // the surface faces away from the light, so it is dark without a ray
    Dark,    // a triangle blocks the ray
    Lit
};

/// A light source, given by a direction or as a point light.
struct LightSource {
    glm::vec3 at{0, 1, 0}; // position, or direction of unit length
    bool isPoint = false;

    /// Returns the unit direction from `position` to the light.
    glm::vec3 from(const glm::vec3& position) const { return isPoint ? glm::normalize(at - position) : at; }

    /// Returns the distance from `position` to the light, or infinity for a direction.
    float distance(const glm::vec3& position) const {
        return isPoint ? glm::length(at - position) : std::numeric_limits<float>::infinity();
    }
};

/// Traces a ray from `point` to the light, and returns whether the light reaches the point.
Light litByRay(const Occluders& scene, const SurfacePoint& point, const LightSource& source);

/// Traces a ray from each point to the light, and returns whether the light reaches the point. Runs on all cores.
std::vector<Light> litByRays(const Occluders& scene, std::span<const SurfacePoint> points, const LightSource& source);

/// The difference between the shadows of a picture and the ground truth. Only lit-side pixels count, which are pixels
/// whose surface faces the light.
struct ShadowComparison {
    std::uint64_t litSidePixels = 0;
    std::uint64_t wrongPixels = 0;
    // number of pixels at shadow edges, in either picture, whose distances are in the statistics below
    std::uint64_t edgePixels = 0;
    // number of pixels at shadow edges of the ground truth that were not measured, because `apart` marks them
    std::uint64_t edgePixelsApart = 0;
    double wrongFraction = 0; // wrong pixels divided by lit-side pixels; 0 without lit-side pixels
    /// Median and percentile of the distance from each shadow edge of either picture to the nearest edge of the other
    /// picture.
    double edgeMedianPixels = 0;
    double edgeP99Pixels = 0;
    double edgeWorstPixels = 0;
    double worstWrongPixels = 0; // max distance of a wrong pixel from an edge of the ground truth
    /// One value per pixel: 0 if the pixel is correct, else its distance to the nearest edge of the ground truth.
    std::vector<float> wrongDistances;
};

/// Returns one value per pixel of the ground truth `reference`, which has `width` columns: 1 for an edge pixel of a
/// shadow, else 0. An edge pixel is a lit-side pixel with a lit-side neighbour (of four) whose result is different.
std::vector<std::uint8_t> shadowEdges(std::span<const Light> reference, std::size_t width);

/// Compares the shadows of a picture with the ground truth `reference`. Both have `width` columns. `isLit` is the
/// result of the picture; it is valid where `reference` is Dark or Lit. An edge pixel is a lit-side pixel with a
/// lit-side neighbour (of four) whose result is different. Distances are between pixel centres. If the other picture
/// has no edge, the distance is the diagonal of the picture.
///
/// `apart` marks the pixels whose shadows the picture may omit. It has one mark per pixel, or is empty. The picture
/// need not show an edge of the ground truth if a pixel on either side is marked. If a marked dark pixel is lit in the
/// picture, the pixel is not wrong. If the picture does show such an edge, the distance to this edge is measured like
/// all others.
ShadowComparison compareShadows(
    std::span<const Light> reference,
    std::span<const std::uint8_t> isLit,
    std::size_t width,
    std::span<const std::uint8_t> apart = {});

/// Returns the exact Euclidean distance of each pixel centre to the nearest marked pixel centre (Felzenszwalb and
/// Huttenlocher 2012). Without marked pixels, returns the diagonal of the picture.
std::vector<float> distanceTransform(std::span<const std::uint8_t> marked, std::size_t width);

} // namespace gnomon::raytrace
