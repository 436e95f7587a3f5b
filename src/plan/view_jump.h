// Which views follow each other as those of one motion do, so that the plan of the second may be steadied by that of
// the first.
#pragma once

#include "core/angle.h"
#include "plan/frame_plan.h"
#include "plan/hysteresis.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

/// Whether `now` shows so much else than the view before it, in which nothing lay farther than `farthest` (world units;
/// 0: it showed nothing), that a plan must not be steadied by that one's (plan/hysteresis.h): another projection or
/// kind of light, or a move of the eye, a turn of its view or of the light, or a change of its angle by more than
/// hysteresis is for. By parallel lines the distance to the target stands for `farthest`, since it is what the picture
/// scales with.
inline bool hasJumped(const View& before, double farthest, const View& now) {
    if (before.camera.projection != now.camera.projection) return true;
    if (before.pointLight.has_value() != now.pointLight.has_value()) return true;
    const bool isParallel = before.camera.isParallel();
    const double reach = isParallel ? glm::length(before.camera.target - before.camera.eye) : farthest;
    if (glm::length(now.camera.eye - before.camera.eye) > kJumpShare * reach) return true;
    const double tanBefore = before.tanHalfY();
    const double tanNow = now.tanHalfY();
    if (std::max(tanBefore, tanNow) > kJumpZoom * std::min(tanBefore, tanNow)) return true;
    const double leastCosine = std::cos(radiansFromDegrees(kJumpDegrees));
    const CameraBasis was = cameraBasis(before.camera);
    const CameraBasis is = cameraBasis(now.camera);
    const bool isTurned = glm::dot(was.view, is.view) < leastCosine || glm::dot(was.up, is.up) < leastCosine;
    return isTurned || glm::dot(before.light().unit(), now.light().unit()) < leastCosine;
}

/// A frame as it was asked for.
struct AskedFrame {
    const View& view;
    const Quality& quality;
};

/// Whether `now` can be the next frame of the motion that `before` belongs to. During a motion the camera, the light
/// and the image size change, and so do the settings that a time target lowers. A change of any other setting ends the
/// motion, and so does a change of any setting while camera and light stand still.
inline bool isSameMotion(const AskedFrame& before, const AskedFrame& now) {
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
