// A picture as a person gets it: the mean of as many frames as it is asked to be.
#pragma once

#include "core/progress.h"
#include "executor/picture.h"
#include "measure/session.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::measure {

/// One view drawn; the session's executor still holds its last frame.
struct FinishedPicture {
    frame::Frame frame; // the first, whose pixels are sampled in their middles
    executor::Picture picture;
    std::optional<executor::Coverage> coverage; // where the background is transparent
};

/// The bands in which `drawFinished` draws the same picture.
std::vector<executor::ImageRows> bandsOf(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples);

/// Draws `view` `samples` times, at least once; where that is more than once and its plan calls for more directions of
/// light, so many times. A picture that does not fit into the session's memory is drawn in bands, to the same bytes.
/// `progress` advances by `samples` in all; its stage is the caller's.
FinishedPicture drawFinished(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples,
    Progress& progress);

} // namespace gnomon::measure
