#include "validation/texel_footprint.h"

#include "render/frame_block.h"

#include <cmath>

namespace gnomon::validation {

TexelProbe::TexelProbe(const render::DrawInputs& frame, const shadow::ShadowMap& map)
    : image_(render::mapDrawing(frame, map).image),
      x_(toWorld(frame.plan->basis, shadow::alongX(map.warped.frame))),
      z_(toWorld(frame.plan->basis, map.warped.frame.z)) {}

glm::dvec2 TexelProbe::texel(const glm::dvec3& p) const {
    const glm::dvec4 clip = glm::dmat4(image_.clipFromOffset) * glm::dvec4(p - glm::dvec3(image_.origin), 1);
    const double up = image_.logRows == 0 ? clip.y / clip.w : std::log(clip.w);
    return glm::dvec2(clip.x / clip.w, up) * glm::dvec2(image_.texelScale) + glm::dvec2(image_.texelOffset);
}

TexelProbe::Derivatives TexelProbe::derivatives(const glm::dvec3& p, double step) const {
    const auto along = [&](const glm::dvec3& axis) {
        return (texel(p + step * axis) - texel(p - step * axis)) / (2 * step);
    };
    return {along(x_), along(z_)};
}

TexelWidths TexelProbe::widths(const glm::dvec3& p, double step) const {
    const Derivatives d = derivatives(p, step);
    // A step along the x axis of light space changes only s. The derivative byX therefore tells whether s is along
    // columns, or along rows in a transposed map.
    const bool isTransposed = std::abs(d.byX.y) > std::abs(d.byX.x);
    const double t = isTransposed ? d.byZ.x : d.byZ.y;
    return {1 / glm::length(d.byX), 1 / std::abs(t)};
}

TexelFootprint TexelProbe::footprint(const glm::dvec3& p, double step) const {
    const Derivatives d = derivatives(p, step);
    const glm::dmat2 inXAndZ = glm::inverse(glm::dmat2(d.byX, d.byZ));
    return {inXAndZ[0].x * x_ + inXAndZ[0].y * z_, inXAndZ[1].x * x_ + inXAndZ[1].y * z_};
}

} // namespace gnomon::validation
