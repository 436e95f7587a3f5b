// A finished picture: the mean of the requested number of frames.
#pragma once

#include "core/progress.h"
#include "render/picture.h"
#include "task/session.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::task {

/// The picture of one view. The backend of the session still contains its last frame.
struct FinishedPicture {
    frame::Frame frame; // the first frame, which samples the centres of the pixels
    render::Picture picture;
    std::optional<render::Coverage> coverage; // only for a transparent background
};

/// Returns the bands of rows in which `drawFinished` draws a picture with the same arguments, from the bottom. There is
/// one band if the picture fits into the memory of the session.
std::vector<render::ImageRows> bandsOf(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples);

/// Draws `samples` frames of `view` (at least 1) and returns their mean. If `samples` is above 1 and the plan requires
/// more light directions than that, draws one frame per direction. A picture that does not fit into the memory of the
/// session is drawn in bands, with the same bytes as result. `progress` advances by `samples` in total. The caller sets
/// its stage.
FinishedPicture drawFinished(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples,
    Progress& progress);

} // namespace gnomon::task
