#include "measure/picture_series.h"

#include "core/angle.h"
#include "core/error.h"
#include "core/prepared_output.h"
#include "executor/picture_series.h"
#include "hierarchy/main_part.h"
#include "measure/finished_picture.h"
#include "path/camera_path.h"
#include "path/outline.h"
#include "settings/resolve.h"
#include "settings/samples.h"

namespace gnomon::measure {

namespace {

constexpr int kUsualFrames = 60;
constexpr double kUsualRate = 25; // frames a second, where no path says

std::string nameOf(const settings::PictureSeries& series, int number) {
    return executor::numberedName(series.output, number).value_or(series.output);
}

/// The view that a series begins with: of a path without framing anything, of a turntable so that every turn of it is
/// in the picture.
plan::View firstView(const SeriesTask& task, const hierarchy::ModelFile& model, bool isWalked) {
    const settings::Settings settings = settings::uprightIn(task.settings, model);
    if (isWalked || !settings::isFramed(settings)) return settings::viewOf(settings, model.summary());
    const glm::dvec3 up = settings.up.value_or(model.summary().up.direction);
    const glm::dvec3 center = hierarchy::mainPartOf(model.summary()).center();
    return settings::viewOf(settings, model.summary(), path::sweptOutline(path::outlineOf(model), center, up));
}

} // namespace

void drawSeries(const settings::PictureSeries& series, const SeriesTask& task, Progress& progress) {
    const bool isNumbered = executor::numberedName(series.output, 0).has_value();
    settings::BesideSamples beside;
    beside.overlay = task.overlay != executor::Overlay::None;
    beside.sunAngle = task.settings.sunAngleDegrees.value_or(0) > 0;
    beside.sky = task.settings.quality.sky.directions > 0;
    settings::requireSound(series, task.settings, isNumbered, beside.overlay);
    const int samples = settings::samplesOf(task.samples, beside);
    std::optional<path::CameraPath> walked;
    if (!series.path.empty()) walked = path::projected(path::readCameraPath(series.path), task.settings.projection);
    const int frames = walked ? series.frames.value_or(kUsualFrames) : series.turntable;
    const bool takesTime = walked && walked->duration() > 0 && frames > 1;
    const bool isStream = series.output == "-";
    const plan::Quality quality = settings::qualityOf(task.settings);
    Session session(task.model, task.settings, task.warn);
    plan::View view = firstView(task, session.model(), walked.has_value());
    const Camera start = view.camera;
    if (isStream)
        task.stream(
            executor::y4mHeader(view.width, view.height, takesTime ? (frames - 1) / walked->duration() : kUsualRate));
    else
        requireWritable(nameOf(series, 0));
    frame::FrameOptions frameOptions;
    frameOptions.overlay = task.overlay;
    progress.stage("render", "frames", static_cast<std::uint64_t>(frames) * static_cast<std::uint64_t>(samples));
    for (int i = 0; i < frames; ++i) {
        view.camera = walked ? path::cameraAt(*walked, path::frameTime(*walked, i, frames))
                             : path::turnedAround(start, view.up, 2 * kPi * i / frames);
        const FinishedPicture drawn = drawFinished(session, view, quality, frameOptions, samples, progress);
        if (isStream)
            task.stream(executor::y4mFrame(drawn.picture));
        else
            executor::writePng(nameOf(series, i), drawn.picture, drawn.coverage);
    }
}

} // namespace gnomon::measure
