// A frame between planning and drawing: its plan, its cut and its resident pages.
#pragma once

#include "frame/ground.h"
#include "lod/cut.h"
#include "lod/page_store.h"
#include "plan/plan_frame.h"
#include "render/backend.h"

#include <memory>
#include <vector>

namespace gnomon::frame {

/// The complete input for drawing one view. The pages of the cut stay resident until the renderer prepares another
/// frame.
struct PreparedFrame {
    plan::FramePlan plan;
    plan::PlanMemory memory; // for the plan of the next frame
    plan::SceneFacts facts;
    std::shared_ptr<const Ground> ground; // null if no part of the ground is in view
    bool hasGround = false;               // true: the view has a ground, in view or not
    render::CameraRelativeSpace space;
    std::shared_ptr<const lod::ErrorRule> rule; // error rule of the cut
    std::vector<ConvexVolume> volumes;          // of the cut: of the image, the casters and the sections
    std::size_t sectionVolumes = 0;             // number of volumes of the sections
    // true: the light reaches so few visible pixels that --shading auto uses the headlight
    bool usesHeadlight = false;
    bool asksLitPixels = false; // true: the number of lit pixels still has to decide `usesHeadlight`
    double errorPixels = 1;     // error limit of the quality, or more if a cap on triangles increases it
    lod::Cut cut;
    lod::DemandOutcome residency;
    double planMs = 0;
    double selectMs = 0;
    double cullMs = 0;
    double streamMs = 0;

    /// Returns true if rays compute the shadows of this frame.
    bool isRayTraced() const {
        return plan.quality.shadows == plan::ShadowMode::Rays && facts.visible && facts.visible->anything;
    }

    /// Returns true if this frame has exact shadows. Returns false if no visible surface can be in shadow.
    bool isExact() const {
        return plan.quality.shadows == plan::ShadowMode::Exact && facts.visible && facts.visible->anything &&
               !facts.isTurnedFromLight;
    }

    /// Returns true if shadows are computed without maps. The only list of casters then contains all casters that can
    /// throw a shadow into the view.
    bool hasOneCasterList() const { return isRayTraced() || isExact(); }
};

} // namespace gnomon::frame
