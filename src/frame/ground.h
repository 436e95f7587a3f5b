// The ground: an invisible plane under the model, which shows only the model's shadows.
#pragma once

#include "hierarchy/model.h"
#include "plan/frame_plan.h"
#include "plan/plan_frame.h"

#include <memory>
#include <span>

namespace gnomon::frame {

/// The part of the ground that the model's shadow can reach: a convex polygon that faces up.
struct Ground {
    std::vector<glm::dvec3> outline; // in world space, in order around the polygon
    hierarchy::Page page;            // the polygon as one cluster on the model's grid, up to two steps below the plane
};

/// The bounds, the grid and the page table of a model.
struct ModelExtent {
    Box bounds; // in world space
    hierarchy::Grid grid;
    std::span<const hierarchy::PageInfo> pages;
};

/// Returns the ground of `view`. Returns null if the look has no ground or if no shadow can be visible on it: the eye
/// is below the ground, or the light is at or below the horizon. The plane touches the lowest corner, along up, of all
/// page boxes. If up is an axis, this is the lowest point of the model. A shadow ends at 16 times the model's diagonal,
/// or at the end of the grid. With `reachesSky`, the ground also contains the points where the model hides a visible
/// share of the sky, more than one level of a screen.
std::shared_ptr<const Ground> groundOf(
    const plan::View& view, const plan::ShadingSettings& look, const ModelExtent& model, bool reachesSky = false);

/// Adds `ground` to `facts`, the facts of a frame of `view` (a distant view if it is orthographic). The part of the
/// ground in the frustum can be in shadow at all its depths. Returns false, without a change, if no part of the ground
/// is in the frustum.
bool addGround(const Ground& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// Returns `ground` after adding it to `facts`, or null if there is no ground in the frustum.
std::shared_ptr<const Ground> seenGround(
    const std::shared_ptr<const Ground>& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// Returns the bounding box of a model and its ground. `ground` can be null.
Box withGround(Box model, const Ground* ground);

/// Returns the max distance, along the light, between a caster in the box `model` and its shadow on `ground`, in world
/// units.
double longestShadow(const Ground& ground, const plan::View& view, const Box& model);

} // namespace gnomon::frame
