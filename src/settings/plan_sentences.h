// Describes the plan of a frame in sentences: the skipped effects with their reasons, the shadows, the light, and the
// source of the depth range. The window, the report and `gnomon explain` use these sentences.
#pragma once

#include "plan/frame_plan.h"

#include <string>

namespace gnomon::settings {

/// Returns the name of an effect that the plan skips, such as "warp" or "map of slice 2".
std::string effectInWords(const plan::SkippedEffect& skipped);

/// Returns half a sentence with the reason why the plan skips an effect, such as "switched off".
std::string reasonInWords(const plan::SkippedEffect& skipped);

/// Returns half a sentence with the reason why the plan uses shadow maps, exact shadows or another kind of shadows.
std::string reasonInWords(plan::ShadowReason reason);

/// Returns one line with the kind of the plan's shadows and the reason for it, such as "shadows exact: they are
/// requested".
std::string shadowsInWords(const plan::FramePlan& plan);

/// Returns lines with the numbers of light directions that are drawn for penumbrae and for the sky. Returns an empty
/// text if the plan uses one direction.
std::string lightInWords(const plan::FramePlan& plan);

/// Returns a phrase for the surface or option that sets the near or far end of the depth range, such as "the nearest
/// surface in view".
std::string sourceInWords(plan::DepthSource source);

} // namespace gnomon::settings
