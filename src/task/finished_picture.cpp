#include "task/finished_picture.h"

#include "frame/accumulation.h"
#include "frame/picture_memory.h"
#include "render/overlay/legend.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gnomon::task {

namespace {

/// Converts the frames of several bands to a fixed total number of progress steps.
class SharedProgress {
public:
    SharedProgress(Progress& progress, int steps, std::size_t parts)
        : progress_(&progress), steps_(static_cast<std::uint64_t>(steps)), parts_(parts) {}

    /// Reports that `done` of `wanted` frames of the current part (a band) are complete. Begins the next part if all
    /// are.
    void tell(int done, int wanted) {
        const std::uint64_t parts = static_cast<std::uint64_t>(wanted) * parts_;
        const std::uint64_t now =
            steps_ * (part_ * static_cast<std::uint64_t>(wanted) + static_cast<std::uint64_t>(done)) / parts;
        progress_->advance(now - told_);
        told_ = now;
        if (done == wanted) ++part_;
    }

private:
    Progress* progress_;
    std::uint64_t steps_;
    std::uint64_t parts_;
    std::uint64_t part_ = 0;
    std::uint64_t told_ = 0;
};

/// The picture of the rows that FrameOptions::rows selects, or of all rows.
struct DrawnRows {
    frame::Frame frame;
    render::Picture picture;
    std::optional<render::Coverage> coverage;
};

DrawnRows drawRows(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples,
    SharedProgress& progress) {
    DrawnRows drawn;
    drawn.frame = session.renderer().render(view, quality, options);
    if (samples > 1) {
        frame::Accumulation accumulation;
        accumulation.begin(session.renderer(), drawn.frame, samples);
        const int wanted = accumulation.wanted();
        progress.tell(1, wanted);
        while (accumulation.samples() < wanted) {
            accumulation.add();
            progress.tell(accumulation.samples(), wanted);
        }
        drawn.picture = accumulation.picture();
        drawn.coverage = accumulation.coverage();
        return drawn;
    }
    progress.tell(1, 1);
    drawn.picture = session.backend().picture();
    if (quality.look.background.kind == plan::Background::Kind::Transparent)
        drawn.coverage = session.backend().coverage();
    return drawn;
}

/// Returns the shading that the whole picture would have, for a picture that is drawn in `bands`. For the shading Auto,
/// this draws the bands with sunlight and counts sunlit pixels. The result is Headlight if the model is visible without
/// a ground and almost no pixel is sunlit.
plan::Shading shadingOf(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    const std::vector<render::ImageRows>& bands) {
    if (quality.look.shading != plan::Shading::Auto) return quality.look.shading;
    plan::Quality lit = quality;
    lit.look.shading = plan::Shading::Lit;
    const frame::Renderer::Motion before = session.renderer().motion();
    std::uint64_t litPixels = 0;
    bool isDark = true;
    for (std::size_t i = 0; i < bands.size() && isDark; ++i) {
        frame::FrameOptions ofBand = options;
        ofBand.rows = bands[i];
        session.renderer().continueFrom(before);
        const frame::Frame frame = session.renderer().render(view, lit, ofBand);
        litPixels += session.backend().litPixels().value_or(0);
        const bool isAnythingSeen = frame.facts.visible && frame.facts.visible->anything;
        isDark = isAnythingSeen && !session.renderer().hasGround() && frame::Renderer::isNextToNothing(litPixels, view);
    }
    session.renderer().continueFrom(before);
    return isDark ? plan::Shading::Headlight : plan::Shading::Lit;
}

} // namespace

std::vector<render::ImageRows> bandsOf(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples) {
    const frame::Residency& residency = session.renderer().residency();
    if (!residency.holdsPictures()) return {{0, view.height}};
    frame::FrameOptions frameOptions = options;
    frameOptions.isAccumulated = samples > 1;
    return frame::bandsOf(view, quality, frameOptions, residency.memory());
}

FinishedPicture drawFinished(
    Session& session,
    const plan::View& view,
    const plan::Quality& quality,
    const frame::FrameOptions& options,
    int samples,
    Progress& progress) {
    frame::Renderer& renderer = session.renderer();
    frame::FrameOptions frameOptions = options;
    frameOptions.isAccumulated = samples > 1;
    const std::vector<render::ImageRows> bands = bandsOf(session, view, quality, options, samples);
    plan::Quality decided = quality;
    if (bands.size() > 1) decided.look.shading = shadingOf(session, view, quality, frameOptions, bands);
    SharedProgress shared(progress, samples, bands.size());
    FinishedPicture finished;
    const frame::Renderer::Motion before = renderer.motion();
    for (const render::ImageRows& band : bands) {
        if (bands.size() > 1) {
            frameOptions.rows = band;
            renderer.continueFrom(before);
        }
        DrawnRows drawn = drawRows(session, view, decided, frameOptions, samples, shared);
        finished.frame = std::move(drawn.frame);
        if (bands.size() == 1) {
            finished.picture = std::move(drawn.picture);
            finished.coverage = std::move(drawn.coverage);
            break;
        }
        const auto put = [&](const auto& rows, auto& whole) {
            if (whole.pixels.empty()) whole = {view.width, view.height};
            const std::size_t top = whole.index(0, view.height - band.first - band.count);
            std::copy(rows.pixels.begin(), rows.pixels.end(), whole.pixels.begin() + static_cast<std::ptrdiff_t>(top));
        };
        put(drawn.picture, finished.picture);
        if (drawn.coverage) put(*drawn.coverage, finished.coverage ? *finished.coverage : finished.coverage.emplace());
    }
    if (bands.size() == 1 && samples == 1)
        render::drawLegend(finished.picture, render::legendOf(options.overlay, finished.frame.plan));
    return finished;
}

} // namespace gnomon::task
