// Ray-traced shadows of an image. They can be displayed, and they are the ground truth for shadow maps.
#pragma once

#include "raytrace/ground_truth.h"
#include "raytrace/kept_trees.h"
#include "render/backend.h"

#include <span>
#include <vector>

namespace gnomon::render {

/// Returns all clusters of `lists` without duplicates, sorted by page. Each range contains one cluster.
std::vector<lod::ClusterRange> distinctClusters(std::span<const lod::DrawList* const> lists);

/// Returns a ray-tracing scene of all clusters of `lists`, without duplicates, in the frame's camera-relative space.
/// The section planes of the frame cut the visible geometry. Shadow rays pass through the removed parts only if the
/// sections also cut casters.
raytrace::Scene rayScene(const DrawInputs& frame, std::span<const lod::DrawList* const> lists);

/// Returns the light of `frame` for ray tracing: the position of a point light or the direction of a directional light,
/// in camera-relative space.
raytrace::LightSource lightSource(const DrawInputs& frame);

/// Distance in pixel widths from a surface to the start of its shadow ray. Without this distance, surfaces that differ
/// only by the grid and the level of detail would shadow each other in specks.
inline constexpr double kContactTolerancePixels = 0.25;

/// Traces a shadow ray for each pixel of `surfaces`, and returns its lit state. Rays start at a distance of
/// `offsetPixels` from the surface. The distance is kContactTolerancePixels, or the error of the surface in pixels if
/// the scene has another level of detail.
std::vector<raytrace::Light> lightByRays(
    const raytrace::Occluders& scene,
    const DrawInputs& frame,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels);

/// Draws `frame`, whose plan has no shadow maps, with ray-traced shadows. Casters are the clusters of the image and of
/// exactCasters. `trees` caches their ray-tracing trees. If the backend supports exact shadows, rays start at the
/// samples of exact shadows, with the same tolerance. If not, rays start kContactTolerancePixels from the surfaces, and
/// the image is drawn twice.
DrawStatistics drawByRays(Backend& backend, DrawInputs frame, raytrace::KeptTrees& trees);

} // namespace gnomon::render
