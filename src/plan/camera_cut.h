// Tests whether two consecutive views belong to one continuous motion. Only then does the plan of the second view use
// the plan memory of the first view.
#pragma once

#include "core/angle.h"
#include "plan/frame_plan.h"
#include "plan/hysteresis.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

/// Returns true if there is a camera cut between the views `before` and `now`. The plan of `now` must then not use the
/// memory of `before`. A camera cut is a change of the projection or of the kind of light. It is also a movement of the
/// eye, a rotation of the view or of the light, or a zoom above a limit in plan/hysteresis.h. `farthest` is the largest
/// visible depth of `before` in world units, or 0 if nothing was visible. Parallel views use the distance to the target
/// instead, because it sets the scale of the image.
inline bool isCameraCut(const View& before, double farthest, const View& now) {
    if (before.camera.projection != now.camera.projection) return true;
    if (before.pointLight.has_value() != now.pointLight.has_value()) return true;
    const bool isParallel = before.camera.isParallel();
    const double reach = isParallel ? glm::length(before.camera.target - before.camera.eye) : farthest;
    if (glm::length(now.camera.eye - before.camera.eye) > kCutShare * reach) return true;
    const double tanBefore = before.tanHalfY();
    const double tanNow = now.tanHalfY();
    if (std::max(tanBefore, tanNow) > kCutZoom * std::min(tanBefore, tanNow)) return true;
    const double minCosine = std::cos(radiansFromDegrees(kCutDegrees));
    const CameraBasis was = cameraBasis(before.camera);
    const CameraBasis is = cameraBasis(now.camera);
    const bool isTurned = glm::dot(was.view, is.view) < minCosine || glm::dot(was.up, is.up) < minCosine;
    return isTurned || glm::dot(before.light().unit(), now.light().unit()) < minCosine;
}

/// The requested view and settings of a frame.
struct RequestedFrame {
    const View& view;
    const Quality& quality;
};

/// Returns true if `now` can be the next frame of the motion of `before`. If camera or light moves, the image size and
/// the settings that a frame-time target adjusts can also change. A change of any other setting ends the motion. If
/// neither camera nor light moves, every change ends the motion.
inline bool isSameMotion(const RequestedFrame& before, const RequestedFrame& now) {
    View view = before.view;
    view.camera = now.view.camera;
    view.towardsLight = now.view.towardsLight;
    view.pointLight = now.view.pointLight;
    if (view == before.view) return before.view == now.view && before.quality == now.quality;
    view.width = now.view.width;
    view.height = now.view.height;
    Quality quality = before.quality;
    quality.errorPixels = now.quality.errorPixels;
    quality.zPartitions = now.quality.zPartitions;
    quality.shadowTexelsWidth = now.quality.shadowTexelsWidth;
    quality.shadowTexelsHeight = now.quality.shadowTexelsHeight;
    quality.mapsBecause = now.quality.mapsBecause;
    return view == now.view && quality == now.quality;
}

} // namespace gnomon::plan
