#include "frame/drawn_maps.h"

#include "plan/map_reuse.h"

namespace gnomon::frame {

MappedImage mappedImage(const PreparedFrame& frame, const FrameOptions& options) {
    MappedImage image{options, frame.usesHeadlight, {}, frame.cut.lists};
    if (frame.ground) image.ground = frame.ground->outline;
    return image;
}

void decideMapReuse(PreparedFrame& frame, const FrameOptions& options, const DrawnMaps* maps) {
    std::vector<plan::ShadowPass>& passes = frame.plan.passes;
    for (plan::ShadowPass& pass : passes)
        pass.isReused = false;
    if (maps == nullptr || !options.reusesMaps) return;
    if (maps->isCulled && !(plan::isSameImage(frame.plan, maps->plan) && mappedImage(frame, options) == maps->image))
        return;
    for (std::size_t p = 0; p < passes.size(); ++p)
        passes[p].isReused = plan::isSameMap(frame.plan, maps->plan, p) &&
                             frame.cut.lists.casters[p].ranges == maps->image.lists.casters[p].ranges;
}

} // namespace gnomon::frame
