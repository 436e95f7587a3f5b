#include "task/finished_picture.h"

#include "frame/accumulation.h"
#include "frame/picture_memory.h"
#include "render/overlay/legend.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace gnomon::task {

namespace {

/// Converts the progress of drawing several bands of rows to a fixed total number of steps.
class SharedProgress {
public:
    SharedProgress(Progress& progress, int steps, std::size_t parts)
        : progress_(&progress), steps_(static_cast<std::uint64_t>(steps)), parts_(parts) {}

    /// Reports that `done` of the `wanted` frames of the current band of rows are complete. If all are complete,
    /// continues with the next band.
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

/// A drawn frame, and the picture of those rows that FrameOptions::rows selects (all rows by default).
struct DrawnRows {
    frame::Frame frame;
    render::Picture picture;
    std::optional<render::Coverage> coverage;
};

DrawnRows drawRows(Session& session, const PictureRequest& request, SharedProgress& progress) {
    DrawnRows drawn;
    drawn.frame = session.renderer().render(request.view, request.quality, request.options, request.history);
    if (request.samples > 1) {
        frame::Accumulation accumulation;
        accumulation.begin(session.renderer(), drawn.frame, request.samples);
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
    if (request.quality.look.background.kind == plan::Background::Kind::Transparent)
        drawn.coverage = session.backend().coverage();
    return drawn;
}

/// Returns the shading for all bands of a picture, so that they look the same. If the requested shading is Auto, the
/// function draws the bands with sunlight and counts the sunlit pixels. The result is Headlight if the model is visible
/// without a ground and almost no pixel is sunlit.
plan::Shading shadingOf(Session& session, PictureRequest request, const std::vector<render::ImageRows>& bands) {
    plan::Shading& shading = request.quality.look.shading;
    if (shading != plan::Shading::Auto) return shading;
    shading = plan::Shading::Lit;
    std::uint64_t litPixels = 0;
    bool isDark = true;
    for (std::size_t i = 0; i < bands.size() && isDark; ++i) {
        request.options.rows = bands[i];
        const frame::Frame frame =
            session.renderer().render(request.view, request.quality, request.options, request.history);
        request.history.maps = frame.history.maps;
        litPixels += session.backend().litPixels().value_or(0);
        const bool isAnythingSeen = frame.facts.visible && frame.facts.visible->anything;
        isDark = isAnythingSeen && !frame.hasGround && frame::Renderer::isNegligible(litPixels, request.view);
    }
    return isDark ? plan::Shading::Headlight : plan::Shading::Lit;
}

/// Draws the picture of `request` band by band and joins the bands.
FinishedPicture drawInBands(
    Session& session, PictureRequest request, const std::vector<render::ImageRows>& bands, SharedProgress& progress) {
    FinishedPicture finished;
    const plan::View& view = request.view;
    for (const render::ImageRows& band : bands) {
        request.options.rows = band;
        DrawnRows drawn = drawRows(session, request, progress);
        finished.frame = std::move(drawn.frame);
        request.history.maps = finished.frame.history.maps; // all bands can use the same maps
        const auto put = [&](const auto& rows, auto& whole) {
            if (whole.pixels.empty()) whole = {view.width, view.height};
            const std::size_t top = whole.index(0, view.height - band.first - band.count);
            std::copy(rows.pixels.begin(), rows.pixels.end(), whole.pixels.begin() + static_cast<std::ptrdiff_t>(top));
        };
        put(drawn.picture, finished.picture);
        if (drawn.coverage) put(*drawn.coverage, finished.coverage ? *finished.coverage : finished.coverage.emplace());
    }
    return finished;
}

} // namespace

std::vector<render::ImageRows> bandsOf(Session& session, const PictureRequest& request) {
    const frame::Residency& residency = session.renderer().residency();
    if (!residency.holdsPictures()) return {{0, request.view.height}};
    frame::FrameOptions options = request.options;
    options.isAccumulated = request.samples > 1;
    return frame::bandsOf(request.view, request.quality, options, residency.memory());
}

FinishedPicture drawFinished(Session& session, const PictureRequest& request, Progress& progress) {
    PictureRequest decided = request;
    decided.options.isAccumulated = request.samples > 1;
    const std::vector<render::ImageRows> bands = bandsOf(session, request);
    SharedProgress shared(progress, request.samples, bands.size());
    if (bands.size() > 1) {
        decided.quality.look.shading = shadingOf(session, decided, bands);
        return drawInBands(session, decided, bands, shared);
    }
    DrawnRows drawn = drawRows(session, decided, shared);
    FinishedPicture finished{std::move(drawn.frame), std::move(drawn.picture), std::move(drawn.coverage)};
    if (request.samples == 1)
        render::drawLegend(finished.picture, render::legendOf(request.options.overlay, finished.frame.plan));
    return finished;
}

} // namespace gnomon::task
