// Draws a picture as the mean of several frames.
#pragma once

#include "core/progress.h"
#include "render/picture.h"
#include "task/session.h"

#include <optional>
#include <string>
#include <vector>

namespace gnomon::task {

/// The finished picture of one view. After it is drawn, the backend of the session still contains the last frame.
struct FinishedPicture {
    frame::Frame frame; // first frame, whose samples are at the centres of the pixels
    render::Picture picture;
    std::optional<render::Coverage> coverage; // only for a transparent background
};

/// The request of a finished picture.
struct PictureRequest {
    plan::View view;
    plan::Quality quality;
    frame::FrameOptions options;
    int samples = 1; // number of frames, at least 1
    frame::History history{};
};

/// Returns the bands of rows in which `drawFinished` draws the picture, from the bottom. There is one band if the whole
/// picture fits into the memory of the session.
std::vector<render::ImageRows> bandsOf(Session& session, const PictureRequest& request);

/// Draws the frames of a picture and returns their mean. If more than one sample is requested, and the plan needs more
/// light directions than samples, draws one frame per light direction. A picture that does not fit into the memory of
/// the session is drawn in bands of rows, with the same bytes as result. `progress` advances by the number of samples
/// in total. The caller sets its stage.
FinishedPicture drawFinished(Session& session, const PictureRequest& request, Progress& progress);

} // namespace gnomon::task
