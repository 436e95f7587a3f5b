// A frame between its plan and its drawing: what the parts of the renderer hand on to each other.
#pragma once

#include "frame/renderer.h"

namespace gnomon::frame {

struct Renderer::Prepared {
    plan::FramePlan plan;
    std::unique_ptr<const selection::ErrorRule> rule; // of the cut, as are the volumes
    std::vector<ConvexVolume> volumes;
    double errorPixels = 1; // the quality's, or more where a cap forces it
    selection::Cut cut;
    plan::SceneFacts facts;
    streaming::DemandOutcome residency;
    double planMs = 0;
    double selectMs = 0;
    double cullMs = 0;
    double streamMs = 0;

    /// Whether rays are to find the shadows of this frame: then the cut's second list holds what they can meet.
    bool isRayTraced() const {
        return plan.quality.shadows == plan::ShadowMode::Rays && facts.visible && facts.visible->anything;
    }
};

} // namespace gnomon::frame
