// Tests whether two consecutive views belong to one continuous camera motion. Only then does the second frame take over
// split depths, map rotation and other hysteresis values from the first frame.
#pragma once

#include "core/angle.h"
#include "plan/frame_plan.h"
#include "plan/hysteresis.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

/// Returns true if the view jumps from `before` to `now`, so that the second frame must not use hysteresis values of
/// the first frame. A jump is a change of the projection or of the type of light. It is also a movement of the eye, a
/// rotation of the view or of the light, or a zoom above a limit in plan/hysteresis.h. `farthest` is the largest
/// visible depth of `before` in world units, or 0 if nothing was visible. Parallel views use the distance to the target
/// instead, because this distance sets the scale of the image.
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

/// Returns true if `now` can be the next frame of the camera motion that `before` belongs to. If camera or light moves,
/// the image size and the settings that a frame-time target adjusts can also change. A change of any other setting ends
/// the motion. If neither camera nor light moves, every change ends the motion.
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
