#include "frame/held_maps.h"

#include "plan/map_reuse.h"

#include <algorithm>
#include <utility>

namespace gnomon::frame {

HeldMaps::Image HeldMaps::imageOf(const PreparedFrame& frame, const FrameOptions& options) {
    Image image;
    image.options = options;
    image.isSunless = frame.isSunless;
    if (frame.ground) image.ground = frame.ground->outline;
    image.lists = frame.cut.lists;
    return image;
}

void HeldMaps::mark(PreparedFrame& frame, const FrameOptions& options) const {
    std::vector<plan::ShadowPass>& passes = frame.plan.passes;
    for (plan::ShadowPass& pass : passes)
        pass.isReused = false;
    if (!held_ || !options.reusesMaps) return;
    if (held_->isCulled && !(plan::isSameImage(frame.plan, held_->plan) && imageOf(frame, options) == held_->image))
        return;
    for (std::size_t p = 0; p < passes.size(); ++p)
        passes[p].isReused = plan::isSameMap(frame.plan, held_->plan, p) &&
                             frame.cut.lists.casters[p].ranges == held_->image.lists.casters[p].ranges;
}

void HeldMaps::hold(const PreparedFrame& frame, const FrameOptions& options, bool isCulled) {
    held_ = Held{frame.plan, imageOf(frame, options), isCulled};
}

} // namespace gnomon::frame
