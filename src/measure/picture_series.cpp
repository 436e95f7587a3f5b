#include "measure/picture_series.h"

#include "core/angle.h"
#include "core/error.h"
#include "core/prepared_output.h"
#include "executor/overlay/legend.h"
#include "executor/picture_series.h"
#include "measure/session.h"
#include "path/camera_path.h"
#include "settings/resolve.h"
#include "settings/usage_error.h"

namespace gnomon::measure {

namespace {

constexpr int kUsualFrames = 60;
constexpr double kUsualRate = 25; // frames a second, where no path says

std::string nameOf(const PictureSeries& series, int number) {
    return executor::numberedName(series.output, number).value_or(series.output);
}

bool isTransparent(const plan::Quality& quality) {
    return quality.look.background.kind == plan::Background::Kind::Transparent;
}

void writePicture(const std::string& path, const executor::Picture& picture, Session& session, bool isTransparent) {
    std::optional<executor::Coverage> coverage;
    if (isTransparent) coverage = executor::coverageOf(session.executor().viewDepth());
    executor::writePng(path, picture, coverage);
}

} // namespace

void requireSound(const PictureSeries& series, const settings::Settings& settings) {
    using settings::UsageError;
    if (!series.path.empty() && series.turntable > 0) throw UsageError{"--path and --turntable contradict each other"};
    if (series.path.empty() && series.frames)
        throw UsageError{"--frames is of a path: --path FILE.json --frames N, or --turntable N"};
    if (!series.path.empty() && settings::isPosed(settings))
        throw UsageError{"--path and --camera, --eye, --target, --up, --fov-y contradict each other"};
    if (series.output == "-" && isTransparent(settings.quality))
        throw UsageError{"--background transparent and -o - contradict each other: YUV4MPEG2 has no alpha"};
    if (series.output != "-" && !executor::numberedName(series.output, 0))
        settings::refuse("--output", series.output, "- or a name with a number in it, such as frame%04d.png");
}

void drawSeries(const PictureSeries& series, const SeriesTask& task, Progress& progress) {
    std::optional<path::CameraPath> walked;
    if (!series.path.empty()) walked = path::readCameraPath(series.path);
    const int frames = walked ? series.frames.value_or(kUsualFrames) : series.turntable;
    const bool takesTime = walked && walked->duration() > 0 && frames > 1;
    const bool isStream = series.output == "-";
    const plan::Quality quality = settings::qualityOf(task.settings);
    if (isTransparent(quality) && task.overlay != executor::Overlay::None)
        throw settings::UsageError{
            "--background transparent and --overlay contradict each other: a legend lies on the background"};
    Session session(task.model, task.settings, task.warn);
    plan::View view = settings::viewOf(task.settings, session.model().summary());
    const Camera start = view.camera;
    if (isStream)
        task.stream(
            executor::y4mHeader(view.width, view.height, takesTime ? (frames - 1) / walked->duration() : kUsualRate));
    else
        requireWritable(nameOf(series, 0));
    frame::FrameOptions frameOptions;
    frameOptions.overlay = task.overlay;
    progress.stage("render", "pictures", static_cast<std::uint64_t>(frames));
    for (int i = 0; i < frames; ++i) {
        view.camera = walked ? path::cameraAt(*walked, path::frameTime(*walked, i, frames))
                             : path::turnedAround(start, 2 * kPi * i / frames);
        const frame::Frame frame = session.renderer().render(view, quality, frameOptions);
        executor::Picture picture = session.executor().picture();
        executor::drawLegend(picture, executor::legendOf(task.overlay, frame.plan));
        if (isStream)
            task.stream(executor::y4mFrame(picture));
        else
            writePicture(nameOf(series, i), picture, session, isTransparent(quality));
        progress.advance(1);
    }
}

} // namespace gnomon::measure
