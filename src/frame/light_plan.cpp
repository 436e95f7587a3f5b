#include "frame/light_plan.h"

#include "culling/open_sky.h"
#include "culling/penumbra_width.h"
#include "frame/frame_cuts.h"

#include <cmath>

namespace gnomon::frame {

void planLightSampling(PreparedFrame& frame, const Residency& residency) {
    plan::FramePlan& plan = frame.plan;
    const selection::CutQuery query = cutQuery(residency, frame);
    const selection::DrawList& image = frame.cut.lists[0];
    if (plan.view.sunAngleRadians > 0) {
        const culling::DiscLight light{plan.light.unit(), 2 * std::tan(plan.view.sunAngleRadians / 2)};
        const double nearest = frame.facts.visible ? frame.facts.visible->nearest : 0;
        const std::span casters = std::span<const selection::DrawList>(frame.cut.lists).subspan(1);
        plan::planPenumbra(plan, culling::widestPenumbra(query, image, casters, light, nearest));
    }
    if (plan.quality.sky.directions > 0) {
        const glm::dvec3 origin = residency.query().trees->grid().origin;
        const Box bounds{frame.facts.bounds.min - origin, frame.facts.bounds.max - origin};
        plan::planSky(plan, culling::mayHideSky(query, image, bounds));
    }
}

} // namespace gnomon::frame
