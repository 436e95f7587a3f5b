#include "proof/texel_footprint.h"

#include "executor/frame_block.h"

#include <algorithm>
#include <cmath>

namespace gnomon::proof {

TexelProbe::TexelProbe(const executor::FrameDrawing& frame, const shadow::ShadowMap& map)
    : image_(executor::mapDrawing(frame, map).image),
      x_(toWorld(frame.plan->basis, shadow::alongX(map.warped.frame))),
      z_(toWorld(frame.plan->basis, map.warped.frame.z)) {
    if (!image_.fitted) return;
    columnStarts_ = startsOf(image_.fitted->columns);
    rowStarts_ = startsOf(image_.fitted->rows);
}

glm::dvec2 TexelProbe::texel(const glm::dvec3& p) const {
    const glm::dvec4 clip = glm::dmat4(image_.clipFromOffset) * glm::dvec4(p - glm::dvec3(image_.origin), 1);
    const double up = image_.logRows == 0 ? clip.y / clip.w : std::log(clip.w);
    glm::dvec2 texel = glm::dvec2(clip.x / clip.w, up) * glm::dvec2(image_.texelScale) + glm::dvec2(image_.texelOffset);
    if (!image_.fitted) return texel;
    return {fitted(image_.fitted->columns, columnStarts_, texel.x), fitted(image_.fitted->rows, rowStarts_, texel.y)};
}

TexelProbe::Starts TexelProbe::startsOf(const shadow::AxisParts<float>& parts) {
    Starts starts{};
    auto at = double{parts.start.front()};
    for (std::size_t i = 0; i < starts.size(); ++i) {
        starts[i] = at;
        at += double{parts.density[i]} / double{parts.partsPerTexel};
    }
    return starts;
}

double TexelProbe::fitted(const shadow::AxisParts<float>& parts, const Starts& starts, double unfitted) {
    const double place = unfitted * double{parts.partsPerTexel};
    const double part = std::clamp(std::floor(place), 0.0, shadow::kFittedParts - 1.0);
    const auto i = static_cast<std::size_t>(part);
    return starts[i] + (place - part) / double{parts.partsPerTexel} * double{parts.density[i]};
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
    const bool isTransposed = std::abs(d.byX.y) > std::abs(d.byX.x);
    const double t = isTransposed ? d.byZ.x : d.byZ.y;
    return {1 / glm::length(d.byX), 1 / std::abs(t)};
}

TexelFootprint TexelProbe::footprint(const glm::dvec3& p, double step) const {
    const Derivatives d = derivatives(p, step);
    const glm::dmat2 inXAndZ = glm::inverse(glm::dmat2(d.byX, d.byZ));
    return {inXAndZ[0].x * x_ + inXAndZ[0].y * z_, inXAndZ[1].x * x_ + inXAndZ[1].y * z_};
}

} // namespace gnomon::proof
