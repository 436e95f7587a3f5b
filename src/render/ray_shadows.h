// Ray-traced shadows of an image: a way to draw shadows, and the reference for shadow maps.
#pragma once

#include "raytrace/ground_truth.h"
#include "raytrace/kept_trees.h"
#include "render/backend.h"

#include <span>
#include <vector>

namespace gnomon::render {

/// Returns the clusters of `lists` without duplicates, one range per cluster, sorted by page.
std::vector<lod::ClusterRange> distinctClusters(std::span<const lod::DrawList* const> lists);

/// Returns a scene of all clusters of `lists`, without duplicates, in the frame's camera-relative space. It is cut by
/// the frame's sections. Rays pass through the removed parts only if the sections cut casters.
raytrace::Scene rayScene(const DrawInputs& frame, std::span<const lod::DrawList* const> lists);

/// Returns the position or direction of the light of `frame` in camera-relative space.
raytrace::LightSource lightSource(const DrawInputs& frame);

/// Offset of a ray's start from its surface, in pixel widths. Without it, surfaces that coincide except for grid and
/// level of detail would shadow each other in specks.
inline constexpr double kContactTolerancePixels = 0.25;

/// Returns the lit state of each pixel of `surfaces`. Rays start `offsetPixels` from the surface:
/// kContactTolerancePixels, or the error of the surface if the scene has another level of detail.
std::vector<raytrace::Light> lightByRays(
    const raytrace::Occluders& scene,
    const DrawInputs& frame,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels);

/// Draws `frame`, whose plan has no maps, with ray-traced shadows. Casters are the image's clusters and exactCasters;
/// `trees` caches their acceleration structures. If the backend supports exact shadows, rays start at their samples
/// with the same tolerance. If not, rays start kContactTolerancePixels from the surfaces, and the image is drawn twice.
DrawStatistics drawByRays(Backend& backend, DrawInputs frame, raytrace::KeptTrees& trees);

} // namespace gnomon::render
