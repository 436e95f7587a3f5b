// A frame between planning and drawing: its plan, its selected clusters and its pages in memory.
#pragma once

#include "frame/ground.h"
#include "lod/cut.h"
#include "lod/page_store.h"
#include "plan/plan_frame.h"
#include "render/backend.h"

#include <memory>
#include <vector>

namespace gnomon::frame {

/// The complete input for drawing one view. The model pages that it draws stay in memory until the renderer prepares
/// another frame.
struct PreparedFrame {
    plan::FramePlan plan;
    plan::PlanMemory memory; // hysteresis values for the plan of the next frame
    plan::SceneFacts facts;
    std::shared_ptr<const Ground> ground; // null if no part of the ground is in view
    bool hasGround = false;               // true: the settings have a ground, even if it is out of view
    render::CameraRelativeSpace space;
    std::shared_ptr<const lod::ErrorRule> rule; // converts a cluster's error to pixels to select its level of detail
    // Volumes whose clusters are selected: first the image, then the casters of each shadow map, then the sections.
    std::vector<ConvexVolume> volumes;
    std::size_t sectionVolumes = 0; // number of section volumes at the end of `volumes`
    // true: the frame is shaded with the headlight, because the sun reaches too few visible pixels (--shading auto)
    bool usesHeadlight = false;
    // true: only drawing can count the lit pixels on which `usesHeadlight` depends
    bool asksLitPixels = false;
    // Max error of the selected clusters in pixels: the limit of the quality, or more because of a cap on triangles.
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

    /// Returns true if rays or exact tests compute the shadows, without shadow maps. The frame then has a single list
    /// of casters instead of one list per map. The list contains all casters that can throw a shadow into the view.
    bool hasOneCasterList() const { return isRayTraced() || isExact(); }
};

} // namespace gnomon::frame
