// What a plan goes without, and where its depth range comes from, in sentences: the one place for all who show them.
#pragma once

#include "plan/frame_plan.h"

#include <string>

namespace gnomon::settings {

/// The name of what is left out: "warp", "map of slice 2".
std::string effectInWords(const plan::Omission& omission);

/// Why, as half a sentence: "switched off".
std::string reasonInWords(const plan::Omission& omission);

/// Returns the reason for the kind of shadows of a frame, as half a sentence.
std::string reasonInWords(plan::ShadowReason reason);

/// Returns the kind of shadows of a plan and the reason, as one line.
std::string shadowsInWords(const plan::FramePlan& plan);

/// From how many directions the light of the plan's pictures comes, a line each; empty where one will do.
std::string lightInWords(const plan::FramePlan& plan);

/// Where an end of the depth range comes from: "the nearest surface in view".
std::string sourceInWords(plan::DepthSource source);

} // namespace gnomon::settings
