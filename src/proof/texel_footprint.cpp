#include "proof/texel_footprint.h"

#include "executor/frame_block.h"

#include <algorithm>
#include <cmath>

namespace gnomon::proof {

TexelProbe::TexelProbe(const plan::FramePlan& plan, const plan::ShadowPass& pass, const executor::DrawSpace& space)
    : clipFromDraw_(glm::mat4(executor::shadowClipFromDraw(pass, space))),
      rectangle_(pass.rectangle),
      x_(toWorld(plan.basis, pass.warp.frame.x)),
      z_(toWorld(plan.basis, pass.warp.frame.z)) {}

glm::dvec2 TexelProbe::texel(const glm::dvec3& p) const {
    const glm::dvec4 clip = clipFromDraw_ * glm::dvec4(p, 1);
    const glm::dvec2 unit = glm::dvec2(clip) / clip.w * 0.5 + 0.5;
    return glm::dvec2(rectangle_.x, rectangle_.y) + unit * glm::dvec2(rectangle_.width, rectangle_.height);
}

TexelProbe::Derivatives TexelProbe::derivatives(const glm::dvec3& p, double step) const {
    const auto along = [&](const glm::dvec3& axis) {
        return (texel(p + step * axis) - texel(p - step * axis)) / (2 * step);
    };
    return {along(x_), along(z_)};
}

TexelWidths TexelProbe::widths(const glm::dvec3& p, double step) const {
    const Derivatives d = derivatives(p, step);
    // x moves along s alone, so it tells whether s lies along columns or, in a map on its side, along rows.
    const bool isTurned = std::abs(d.byX.y) > std::abs(d.byX.x);
    const double t = isTurned ? d.byZ.x : d.byZ.y;
    return {1 / glm::length(d.byX), 1 / std::abs(t)};
}

TexelFootprint TexelProbe::footprint(const glm::dvec3& p, double step) const {
    const Derivatives d = derivatives(p, step);
    const glm::dmat2 inXAndZ = glm::inverse(glm::dmat2(d.byX, d.byZ));
    return {inXAndZ[0].x * x_ + inXAndZ[0].y * z_, inXAndZ[1].x * x_ + inXAndZ[1].y * z_};
}

} // namespace gnomon::proof
