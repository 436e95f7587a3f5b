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

/// The complete input for drawing one view. The pages of its cut stay resident until the renderer prepares another
/// frame.
struct PreparedFrame {
    plan::FramePlan plan;
    plan::PlanMemory memory; // for the plan of the next frame
    plan::SceneFacts facts;
    std::shared_ptr<const Ground> ground; // null if no part of the ground is in view
    bool hasGround = false;               // true: the look has a ground, even if the ground is out of view
    render::CameraRelativeSpace space;
    std::shared_ptr<const lod::ErrorRule> rule; // error rule of the cut
    // volumes of the cut: the image, the casters of each pass, and the sections
    std::vector<ConvexVolume> volumes;
    std::size_t sectionVolumes = 0; // number of section volumes at the end of `volumes`
    // true: shades with the headlight, because the sun reaches too few visible pixels (--shading auto)
    bool usesHeadlight = false;
    // true: `usesHeadlight` depends on the number of lit pixels, which only drawing can count
    bool asksLitPixels = false;
    // error limit of the cut in pixels: the limit of the quality, or more if a cap on triangles requires it
    double errorPixels = 1;
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

    /// Returns true if this frame computes exact shadows. Returns false if no visible surface can be in shadow.
    bool isExact() const {
        return plan.quality.shadows == plan::ShadowMode::Exact && facts.visible && facts.visible->anything &&
               !facts.isTurnedFromLight;
    }

    /// Returns true if shadows are computed without maps. The cut then has a single list of casters. It contains all
    /// casters that can throw a shadow into the view.
    bool hasOneCasterList() const { return isRayTraced() || isExact(); }
};

} // namespace gnomon::frame
