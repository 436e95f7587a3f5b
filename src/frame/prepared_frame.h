// A frame between its plan and its drawing: what was planned, cut and made resident for one view.
#pragma once

#include "executor/executor.h"
#include "frame/ground.h"
#include "plan/plan_frame.h"
#include "selection/cut.h"
#include "streaming/page_store.h"

#include <memory>
#include <vector>

namespace gnomon::frame {

/// All that drawing one view takes. The cut's pages stay resident until the renderer prepares another frame.
struct PreparedFrame {
    plan::FramePlan plan;
    plan::PlanMemory memory;                          // for the plan of the next frame
    std::shared_ptr<const plan::PlannedFrame> before; // the frame before, for hysteresis; null if there was none
    plan::SceneFacts facts;
    std::shared_ptr<const Ground> ground; // null where none of it is in view
    executor::DrawSpace space;
    std::shared_ptr<const selection::ErrorRule> rule; // of the cut, as are the volumes
    std::vector<ConvexVolume> volumes;
    bool isSunless = false; // the light reaches next to nothing that is seen, and --shading auto makes do without
    double errorPixels = 1; // the quality's, or more where a cap forces it
    selection::Cut cut;     // lists: the image's, then one a shadow pass, or that of the casters that rays can meet
    streaming::DemandOutcome residency;
    double planMs = 0;
    double selectMs = 0;
    double cullMs = 0;
    double streamMs = 0;

    /// Whether rays are to find the shadows of this frame.
    bool isRayTraced() const {
        return plan.quality.shadows == plan::ShadowMode::Rays && facts.visible && facts.visible->anything;
    }

    /// Whether its shadows are decided exactly; not so where nothing that is seen could be in one.
    bool isExact() const {
        return plan.quality.shadows == plan::ShadowMode::Exact && facts.visible && facts.visible->anything &&
               !facts.isTurnedFromLight;
    }

    /// Whether shadows are found without maps: the second list is that of all that can cast into the view.
    bool hasOneCasterList() const { return isRayTraced() || isExact(); }
};

} // namespace gnomon::frame
