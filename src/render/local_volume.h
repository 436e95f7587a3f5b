// From the plan's camera space to the model's local space, in which the hierarchy is asked.
#pragma once

#include "plan/frame_plan.h"
#include "selection/error_rule.h"

namespace gnomon::render {

/// `volume` of camera space in local space, whose axes are the world's; `eye` is local.
ConvexVolume toLocal(const CameraBasis& basis, const glm::dvec3& eye, const ConvexVolume& volume);

/// The view of `plan` for choosing detail; `eye` is local.
selection::DetailView detailView(const plan::FramePlan& plan, const glm::dvec3& eye);

/// What the casters of `pass` must be exact enough for; `eye` is local.
selection::CasterDetail casterDetail(const plan::FramePlan& plan, const plan::ShadowPass& pass, const glm::dvec3& eye);

} // namespace gnomon::render
