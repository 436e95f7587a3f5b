// The state that must stay continuous between the frames of a sequence. Each frame receives the history of the previous
// frame, and returns its own history.
#pragma once

#include "plan/plan_frame.h"

#include <memory>
#include <optional>

namespace gnomon::frame {

struct DrawnMaps;

/// The history of a frame. A default history has no previous frame, so the next frame depends only on its own view.
struct History {
    std::shared_ptr<const plan::PlannedFrame> previous; // the previous frame; its memory provides the hysteresis
    plan::View view;                                    // requested view of the previous frame
    plan::Quality quality;
    double farthest = 0; // largest visible depth of the previous frame
    // true: Shading::Auto uses the headlight in this motion; false: it uses the sun; nullopt: not known yet
    std::optional<bool> usesHeadlight;
    // The shadow maps of the previous frame in the depth texture; null: none. A renderer reuses a map only if its
    // texture still contains these maps.
    std::shared_ptr<const DrawnMaps> maps;

    /// Returns the memory for the plan of the next frame.
    plan::PlanMemory memory() const { return previous ? previous->memory : plan::PlanMemory(); }
};

/// Returns the part of `history` that a frame of `view` with `quality` can use. If the frame does not continue the
/// motion of the previous frame (plan/camera_cut.h), the plan memory and the choice of the headlight are removed.
History continuedHistory(const History& history, const plan::View& view, const plan::Quality& quality);

} // namespace gnomon::frame
