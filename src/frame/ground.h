// The ground under a model, which nothing but its shadow makes visible.
#pragma once

#include "hierarchy/model.h"
#include "plan/frame_plan.h"
#include "plan/plan_frame.h"

#include <memory>
#include <span>

namespace gnomon::frame {

/// The part of the plane under a model in which its shadow can lie: a convex polygon, facing up.
struct Ground {
    std::vector<glm::dvec3> outline; // world space, in order around
    hierarchy::Page page;            // the same as one cluster, on the model's grid and up to two steps lower
};

/// What is known of a model's shape without its pages.
struct ModelExtent {
    Box bounds; // world space
    hierarchy::Grid grid;
    std::span<const hierarchy::PageInfo> pages;
};

/// The ground of `view`; null where none is asked for or no shadow can be seen on it: from below, or with the light at
/// the horizon or under it. The plane lies under the least corner along up of any page's box, which is the model's
/// lowest point where up is an axis. A shadow longer than 16 times the model ends there, or where the grid does.
/// With `reachesSky` it is as much wider as it takes to hold what the model hides of the sky but for a level of a
/// screen.
std::shared_ptr<const Ground> groundOf(
    const plan::View& view, const plan::Look& look, const ModelExtent& model, bool reachesSky = false);

/// `facts` of a frame of `view`, a distant one if it is orthographic, that shows `ground` too: what of it is in the
/// frustum can be shadowed at any depth. False, and nothing changed, where that is none of it.
bool addGround(const Ground& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// `ground` itself, if `facts` got it so; else null, as without one.
std::shared_ptr<const Ground> seenGround(
    const std::shared_ptr<const Ground>& ground, const plan::View& view, double gridStep, plan::SceneFacts& facts);

/// The box of a model and the ground under it, which may be null.
Box withGround(Box model, const Ground* ground);

/// How far a shadow on `ground` may lie from what of the box `model` throws it, along the light, at most.
double longestShadow(const Ground& ground, const plan::View& view, const Box& model);

} // namespace gnomon::frame
