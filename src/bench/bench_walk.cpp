#include "bench/bench_walk.h"

#include "render/overlay/legend.h"
#include "settings/resolve.h"
#include "telemetry/process_clock.h"

#include <algorithm>
#include <chrono>
#include <thread>

namespace gnomon::bench {

Walk::Walk(task::Session& session, const path::CameraPath& path, const WalkOptions& options, RunResult& result)
    : session_(session),
      path_(path),
      options_(options),
      result_(result),
      view_(settings::viewOf(settings::uprightIn(result.run.settings, session.model()), session.model().summary())),
      quality_(settings::qualityOf(result.run.settings)) {
    // All frames use the sun, also frames with few sunlit pixels, because frames are compared with each other.
    if (quality_.look.shading == plan::Shading::Auto) quality_.look.shading = plan::Shading::Lit;
    frameOptions_.waiting = options.isRealTime ? frame::Waiting::Never : frame::Waiting::UntilComplete;
}

void Walk::repeat(int repetition, const OnFrame& onFrame, Progress& progress) {
    warmUp(progress);
    const auto start = std::chrono::steady_clock::now();
    for (int frame = 0; frame < options_.frames; ++frame) {
        if (options_.isRealTime)
            std::this_thread::sleep_until(start + std::chrono::duration<double>(timeOf(frame) - timeOf(0)));
        const double cpuBefore = telemetry::processorTime().count;
        telemetry::FrameRow row = draw(frame).row;
        result_.rowCpuMs.push_back(telemetry::processorTime().count - cpuBefore);
        result_.cpuMs += result_.rowCpuMs.back() / (options_.frames * options_.repetitions);
        row.run = result_.run.name;
        row.repetition = repetition;
        row.frame = frame;
        row.timeS = timeOf(frame);
        result_.rows.push_back(row);
        if (onFrame) onFrame(frame, session_.backend().picture());
        progress.advance(1);
    }
}

void Walk::validate(Progress& progress) {
    warmUp(progress);
    validation::ValidationOptions options;
    options.measuresAliasing = options.measuresCrawl = options.comparesWithFinest = true;
    options.groundTruth = options_.groundTruth;
    options.countsWrongPixels = options_.countsWrongPixels;
    for (int frame = 0; frame < options_.frames; ++frame) {
        const frame::Frame drawn = draw(frame);
        if (isProvenFrame(frame))
            validation::setAccuracy(
                validation::validate(session_.renderer(), drawn, options),
                result_.rows[static_cast<std::size_t>(frame)]);
        progress.advance(1);
    }
}

double Walk::drawnWork(int frame) {
    const telemetry::FrameRow row = draw(frame).row;
    history_ = {};
    const std::int64_t pixels = std::int64_t{view_.width} * view_.height;
    return static_cast<double>(row.imageTriangles.value_or(0) + row.shadowTriangles.value_or(0) + 2 * pixels);
}

render::Picture Walk::picture(render::Overlay overlay, Progress& progress) {
    frameOptions_.overlay = overlay;
    history_ = {};
    const frame::Frame drawn = draw(options_.frames / 2);
    if (overlay == render::Overlay::None) quality_.shadows = drawn.plan.quality.shadows; // also for overlays
    progress.advance(1);
    render::Picture picture = session_.backend().picture();
    render::drawLegend(picture, render::legendOf(overlay, drawn.plan));
    return picture;
}

void Walk::warmUp(Progress& progress) {
    history_ = {};
    for (int i = 0; i < options_.warmup; ++i) {
        draw(0);
        progress.advance(0); // warm-up frames do not count, but an interruption can stop here
    }
    history_ = {};
}

bool Walk::isProvenFrame(int frame) const {
    const int last = std::min(options_.provenFrames, options_.frames) - 1;
    for (int i = 0; i <= last; ++i)
        if (frame == (last == 0 ? options_.frames / 2 : i * (options_.frames - 1) / last)) return true;
    return false;
}

frame::Frame Walk::draw(int frame) {
    view_.camera = path::cameraAt(path_, timeOf(frame));
    frame::Frame drawn = session_.renderer().render(view_, quality_, frameOptions_, history_);
    history_ = drawn.history;
    drawn.row.sinceStartMs = telemetry::sinceProcessStart().count;
    if (result_.firstFrameMs == 0) result_.firstFrameMs = *drawn.row.sinceStartMs;
    return drawn;
}

} // namespace gnomon::bench
