// The ground: an invisible plane under the model that shows the shadow of the model.
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

/// Returns the visible ground plane under the model. Returns null if `look` has no ground, or if no shadow can be
/// visible on it because the eye is below it or the light is at or below the horizon. The plane touches the lowest
/// corner of all page boxes, measured along `up`. If `up` is an axis, this corner has the height of the lowest point of
/// the model. A shadow ends at 16 times the model's diagonal, or at the end of the model's grid. With `reachesSky`, the
/// ground also contains all points where the model hides so much of the sky that an 8-bit image shows it.
std::shared_ptr<const Ground> groundOf(
    const plan::View& view, const plan::ShadingSettings& look, const ModelExtent& model, bool reachesSky = false);

/// Adds `ground` to `facts`, the scene facts of `view`. Orthographic views must first be converted by
/// plan::distantView. Any visible part of the ground counts as a possible receiver. Returns false, and changes nothing,
/// if no part of the ground is in the view frustum.
bool addGround(const Ground& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// Adds `ground` to the scene facts `facts` and returns it. Returns null, and changes nothing, if no part of the ground
/// is in the view frustum.
std::shared_ptr<const Ground> seenGround(
    const std::shared_ptr<const Ground>& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// Returns the bounding box of a model and its ground. `ground` can be null.
Box withGround(Box model, const Ground* ground);

/// Returns the max distance, along the light direction, between a caster in the box `model` and its shadow on `ground`,
/// in world units.
double longestShadow(const Ground& ground, const plan::View& view, const Box& model);

} // namespace gnomon::frame
