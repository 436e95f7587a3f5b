#include "measure/picture_series.h"

#include "core/angle.h"
#include "core/error.h"
#include "core/prepared_output.h"
#include "executor/overlay/legend.h"
#include "executor/picture_series.h"
#include "measure/session.h"
#include "path/camera_path.h"
#include "settings/resolve.h"

namespace gnomon::measure {

namespace {

constexpr int kUsualFrames = 60;
constexpr double kUsualRate = 25; // frames a second, where no path says

std::string nameOf(const settings::PictureSeries& series, int number) {
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

void drawSeries(const settings::PictureSeries& series, const SeriesTask& task, Progress& progress) {
    const bool isNumbered = executor::numberedName(series.output, 0).has_value();
    settings::requireSound(series, task.settings, isNumbered, task.overlay != executor::Overlay::None);
    std::optional<path::CameraPath> walked;
    if (!series.path.empty()) walked = path::readCameraPath(series.path);
    const int frames = walked ? series.frames.value_or(kUsualFrames) : series.turntable;
    const bool takesTime = walked && walked->duration() > 0 && frames > 1;
    const bool isStream = series.output == "-";
    const plan::Quality quality = settings::qualityOf(task.settings);
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
