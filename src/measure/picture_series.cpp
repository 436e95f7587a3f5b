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

#include <algorithm>
#include <vector>

namespace gnomon::measure {

namespace {

constexpr int kUsualFrames = 60;
constexpr double kUsualRate = 25; // frames per second without the times of a path

std::string nameOf(const settings::PictureSeries& series, int number) {
    return executor::numberedName(series.output, number).value_or(series.output);
}

/// Returns the first view of a series. On a turntable without a given eye, it frames the model in all its rotations. A
/// path has its own cameras, so its view does not have to frame the model.
plan::View firstView(const SeriesTask& task, const hierarchy::ModelFile& model, bool isWalked) {
    const settings::Settings settings = settings::uprightIn(task.settings, model);
    if (isWalked || !settings::isFramed(settings)) return settings::viewOf(settings, model.summary());
    const glm::dvec3 up = settings.up.value_or(model.summary().up.direction);
    const glm::dvec3 center = hierarchy::mainPartOf(model.summary()).center();
    return settings::viewOf(settings, model.summary(), path::sweptOutline(path::outlineOf(model), center, up));
}

/// Returns the common shading of all pictures of a series, so that it does not change between them. For the shading
/// Auto, this draws small pictures of up to 16 of the `cameras`. The result is Headlight if more than half of them show
/// almost no sunlight.
plan::Shading commonShading(
    Session& session, plan::View view, const plan::Quality& quality, const std::vector<Camera>& cameras) {
    constexpr std::size_t kMaxLooks = 16;
    constexpr int kReduction = 4; // divisor of width and height
    if (quality.look.shading != plan::Shading::Auto) return quality.look.shading;
    view.width = std::max(view.width / kReduction, 1);
    view.height = std::max(view.height / kReduction, 1);
    const std::size_t looks = std::min(cameras.size(), kMaxLooks);
    std::size_t sunless = 0;
    for (std::size_t i = 0; i < looks; ++i) {
        view.camera = cameras[i * cameras.size() / looks];
        session.renderer().forget();
        sunless += session.renderer().render(view, quality, {}).isSunless ? 1 : 0;
    }
    session.renderer().forget();
    session.renderer().takeShortfall();
    return 2 * sunless > looks ? plan::Shading::Headlight : plan::Shading::Lit;
}

std::vector<Camera> camerasOf(const std::optional<path::CameraPath>& walked, const plan::View& first, int frames) {
    std::vector<Camera> cameras;
    cameras.reserve(static_cast<std::size_t>(frames));
    for (int i = 0; i < frames; ++i)
        cameras.push_back(
            walked ? path::cameraAt(*walked, path::frameTime(*walked, i, frames))
                   : path::turnedAround(first.camera, first.up, 2 * kPi * i / frames));
    return cameras;
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
    plan::Quality quality = settings::qualityOf(task.settings);
    Session session(task.model, task.settings, task.warn, settings::DrawingCommand::Render, frames);
    plan::View view = firstView(task, session.model(), walked.has_value());
    const std::vector<Camera> cameras = camerasOf(walked, view, frames);
    if (isStream)
        task.stream(executor::y4mHeader(
            view.width, view.height, takesTime ? path::frameSteps(*walked, frames) / walked->duration() : kUsualRate));
    else
        requireWritable(nameOf(series, 0));
    frame::FrameOptions frameOptions;
    frameOptions.overlay = task.overlay;
    progress.stage("render", "frames", static_cast<std::uint64_t>(frames) * static_cast<std::uint64_t>(samples));
    // Reserve the memory of the large pictures first. Otherwise the pages for the small pictures could use it.
    frame::FrameOptions whole = frameOptions;
    whole.isAccumulated = samples > 1;
    whole.rows = bandsOf(session, view, quality, frameOptions, samples).front();
    session.renderer().reservePicture(view, quality, whole);
    quality.look.shading = commonShading(session, view, quality, cameras);
    for (int i = 0; i < frames; ++i) {
        view.camera = cameras[static_cast<std::size_t>(i)];
        const FinishedPicture drawn = drawFinished(session, view, quality, frameOptions, samples, progress);
        if (isStream)
            task.stream(executor::y4mFrame(drawn.picture));
        else
            executor::writePng(nameOf(series, i), drawn.picture, drawn.coverage);
    }
    session.tellShortfall();
}

} // namespace gnomon::measure
