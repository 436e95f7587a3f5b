// Shadows of a picture by rays: the reference that shadow maps are held against, and a way to draw them.
#pragma once

#include "executor/executor.h"
#include "raycast/kept_trees.h"
#include "raycast/shadow_oracle.h"

#include <span>
#include <vector>

namespace gnomon::executor {

/// The clusters of `lists`, each once and as a range of its own, by page.
std::vector<selection::ClusterRange> distinctClusters(std::span<const selection::DrawList* const> lists);

/// The clusters of `lists`, each once, as rays meet them in the frame's draw space, cut by its sections: what rays are
/// stopped by only where those cut casters.
raycast::Scene rayScene(const FrameDrawing& frame, std::span<const selection::DrawList* const> lists);

/// Where the light of `frame` comes from, in draw space.
raycast::LightSource lightSource(const FrameDrawing& frame);

/// How far from a surface a ray towards the light begins, in widths of the pixel: what is nearer touches it. Surfaces
/// that coincide but for the grid and the level of detail would else shadow each other in specks.
inline constexpr double kTouchingPixels = 0.25;

/// What the light reaches of `surfaces`, per pixel. Rays begin `offsetPixels` from the surface: kTouchingPixels, or the
/// error of the surface where the scene is of another level of detail.
std::vector<raycast::Light> lightByRays(
    const raycast::Occluders& scene,
    const FrameDrawing& frame,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels);

/// Draws `frame`, whose plan has no maps, in the shadows that rays find among its image's clusters and exactCasters,
/// over trees that are kept. They begin at the samples of exact shadows where the executor has those, with the same
/// tolerance; else kTouchingPixels off its surfaces, for which the image is drawn twice.
DrawStatistics drawByRays(Executor& executor, FrameDrawing frame, raycast::KeptTrees& trees);

} // namespace gnomon::executor
