#include "measure/finished_picture.h"

#include "executor/overlay/legend.h"
#include "frame/accumulation.h"

namespace gnomon::measure {

FinishedPicture drawFinished(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples,
    Progress& progress) {
    frame::FrameOptions frameOptions = options;
    frameOptions.isAccumulated = samples > 1;
    FinishedPicture finished;
    finished.frame = session.renderer().render(view, quality, frameOptions);
    const bool isTransparent = quality.look.background.kind == plan::Background::Kind::Transparent;
    if (samples > 1) {
        frame::Accumulation accumulation;
        accumulation.begin(session.renderer(), finished.frame, samples);
        const auto whole = static_cast<std::uint64_t>(samples);
        const auto wanted = static_cast<std::uint64_t>(accumulation.wanted());
        std::uint64_t told = whole / wanted;
        progress.advance(told);
        while (accumulation.samples() < accumulation.wanted()) {
            accumulation.add();
            const std::uint64_t done = whole * static_cast<std::uint64_t>(accumulation.samples()) / wanted;
            progress.advance(done - told);
            told = done;
        }
        finished.picture = accumulation.picture();
        finished.coverage = accumulation.coverage();
        return finished;
    }
    progress.advance(1);
    finished.picture = session.executor().picture();
    executor::drawLegend(finished.picture, executor::legendOf(options.overlay, finished.frame.plan));
    if (isTransparent) finished.coverage = session.executor().coverage();
    return finished;
}

} // namespace gnomon::measure
