// Shadows of a picture by exact rays: the reference that shadow maps are held against.
#pragma once

#include "executor/executor.h"
#include "raycast/shadow_oracle.h"

#include <span>
#include <vector>

namespace gnomon::executor {

/// The clusters of `lists`, each once and as a range of its own, by page.
std::vector<selection::ClusterRange> distinctClusters(std::span<const selection::DrawList* const> lists);

/// The clusters of `lists`, each once, as rays meet them in the frame's draw space.
raycast::Scene rayScene(const FrameDrawing& frame, std::span<const selection::DrawList* const> lists);

/// The direction towards the light in draw space.
glm::vec3 towardsLight(const plan::FramePlan& plan);

/// How far from a surface a ray towards the light begins, in widths of the pixel: what is nearer touches it. Surfaces
/// that coincide but for the grid and the level of detail would else shadow each other in specks.
inline constexpr double kTouchingPixels = 0.25;

/// What the light reaches of `surfaces`, per pixel. Rays begin `offsetPixels` from the surface: kTouchingPixels, or the
/// error of the surface where the scene is of another level of detail.
std::vector<raycast::Light> lightByRays(
    const raycast::Scene& scene,
    const plan::FramePlan& plan,
    const DrawSpace& space,
    const Raster<SurfaceSample>& surfaces,
    double offsetPixels);

/// The shadows of a frame by rays, in place of maps.
struct TracedShadows {
    Raster<std::uint8_t> litMask; // for FrameDrawing::litMask
    PassStatistics statistics;    // with the image that tells where the rays begin
};

/// Draws the image of `frame`, whose plan has no maps, for its surfaces alone, and traces rays from them to the light
/// against the image's list and `casters`.
TracedShadows traceShadows(Executor& executor, FrameDrawing frame, const selection::DrawList& casters);

} // namespace gnomon::executor
