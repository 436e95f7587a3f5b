// Sentences about a plan: its skipped effects with their reasons, its shadows, its light and the source of its depth
// range. The window, the report and `gnomon explain` all use these sentences.
#pragma once

#include "plan/frame_plan.h"

#include <string>

namespace gnomon::settings {

/// Returns the name of the skipped effect: "warp", "map of slice 2".
std::string effectInWords(const plan::SkippedEffect& skipped);

/// Returns the reason for the skipped effect, as half a sentence: "switched off".
std::string reasonInWords(const plan::SkippedEffect& skipped);

/// Returns the reason for the choice of shadow maps, exact shadows or others, as half a sentence.
std::string reasonInWords(plan::ShadowReason reason);

/// Returns one line with the kind of the plan's shadows and its reason: "shadows exact: they are requested".
std::string shadowsInWords(const plan::FramePlan& plan);

/// Returns lines with the numbers of light directions for penumbrae and for the sky. Returns an empty text if one
/// direction is sufficient.
std::string lightInWords(const plan::FramePlan& plan);

/// Returns the source of an end of the depth range: "the nearest surface in view".
std::string sourceInWords(plan::DepthSource source);

} // namespace gnomon::settings
