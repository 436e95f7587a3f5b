// Stores the state of a frame that must stay continuous in the next frame, such as split depths and hysteresis. Each
// frame receives the history of the previous frame, and returns its own history.
#pragma once

#include "plan/plan_frame.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

struct DrawnMaps;

/// The state that one frame passes to the next frame. With a default value, the next frame depends only on its own
/// view.
struct History {
    std::shared_ptr<const plan::PlannedFrame> previous; // plan of the previous frame with its hysteresis
    plan::View view;                                    // requested view of the previous frame
    plan::Quality quality;
    double farthest = 0; // largest visible depth of the previous frame
    // Choice of Shading::Auto in this camera motion. true: headlight; false: sun; nullopt: not known yet.
    std::optional<bool> usesHeadlight;
    // The shadow maps that the previous frame drew into the depth texture, or null. A renderer reuses a map only if its
    // texture still contains the map.
    std::shared_ptr<const DrawnMaps> maps;

    /// Returns the hysteresis values that the plan of the next frame uses. They are empty without a previous frame.
    plan::PlanMemory memory() const { return previous ? previous->memory : plan::PlanMemory(); }
};

/// Returns the part of `history` that a frame of `view` with `quality` can use. If the frame does not continue the
/// camera motion of the previous frame (plan/camera_cut.h), the hysteresis values and the choice of the headlight are
/// removed.
History continuedHistory(const History& history, const plan::View& view, const plan::Quality& quality);

} // namespace gnomon::frame
