#include "task/render.h"

#include "core/angle.h"
#include "core/file.h"
#include "core/prepared_output.h"
#include "inspect/value_picture.h"
#include "render/picture_series.h"
#include "render/shadow_maps.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "task/finished_picture.h"
#include "telemetry/process_clock.h"
#include "validation/frame_validation.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace gnomon::task {

namespace {

using settings::Output;

constexpr int kUsualFrames = 60;
constexpr double kUsualRate = 25; // frames per second, if no path gives the rate

/// Returns the measurements of a picture's frame (its log row) as JSON.
std::string renderRow(telemetry::FrameRow row) {
    row.run = "render";
    row.sinceStartMs = telemetry::sinceProcessStart().count;
    return telemetry::jsonObject(row) + "\n";
}

/// Returns the depth images of a frame that `output` requests, each with the path of its file.
std::vector<render::NamedDepths> depthsOf(const Output& output, const plan::FramePlan& plan, render::Backend& backend) {
    std::vector<render::NamedDepths> depths;
    if (!output.shadowDepth.empty()) depths = render::shadowMaps(plan, backend);
    for (render::NamedDepths& map : depths)
        map.path = (std::filesystem::path(output.shadowDepth) / map.path).string();
    if (!output.depth.empty()) depths.push_back({output.depth, backend.viewDepth()});
    return depths;
}

/// Returns the shading for all pictures of a series, so that it does not change between them. If `quality` requests the
/// shading Auto, the function draws small pictures of up to 16 of the `cameras`. The result is Headlight if almost no
/// pixel is sunlit in more than half of them.
plan::Shading commonShading(
    Session& session, plan::View view, const plan::Quality& quality, const std::vector<Camera>& cameras) {
    constexpr std::size_t kMaxLooks = 16;
    constexpr int kReduction = 4; // divides the width and the height of the pictures
    if (quality.look.shading != plan::Shading::Auto) return quality.look.shading;
    view.width = std::max(view.width / kReduction, 1);
    view.height = std::max(view.height / kReduction, 1);
    const std::size_t looks = std::min(cameras.size(), kMaxLooks);
    std::size_t headlit = 0;
    for (std::size_t i = 0; i < looks; ++i) {
        view.camera = cameras[i * cameras.size() / looks];
        headlit += session.renderer().render(view, quality, {}).usesHeadlight ? 1 : 0;
    }
    session.renderer().takeShortfall();
    return 2 * headlit > looks ? plan::Shading::Headlight : plan::Shading::Lit;
}

std::vector<Camera> camerasOf(const std::optional<path::CameraPath>& path, const plan::View& first, int frames) {
    std::vector<Camera> cameras;
    cameras.reserve(static_cast<std::size_t>(frames));
    for (int i = 0; i < frames; ++i)
        cameras.push_back(
            path ? path::cameraAt(*path, path::frameTime(*path, i, frames))
                 : path::turnedAround(first.camera, first.up, 2 * kPi * i / frames));
    return cameras;
}

void drawSeries(const RenderTask& task, const plan::View& view, Session& session, Progress& progress) {
    const std::vector<Camera> cameras = camerasOf(task.path, view, task.pictures);
    const bool isStream = task.output.picture == "-";
    const bool takesTime = task.path && task.path->duration() > 0 && task.pictures > 1;
    const auto nameOf = [&](int number) {
        return render::numberedName(task.output.picture, number).value_or(task.output.picture);
    };
    if (isStream)
        task.stream(render::y4mHeader(
            view.width,
            view.height,
            takesTime ? path::frameSteps(*task.path, task.pictures) / task.path->duration() : kUsualRate));
    else
        requireWritable(nameOf(0));
    frame::FrameOptions frameOptions;
    frameOptions.overlay = task.output.overlay;
    progress.stage(
        "render", "frames", static_cast<std::uint64_t>(task.pictures) * static_cast<std::uint64_t>(task.samples));
    // Memory for the large pictures is reserved first. The small pictures, which select the shading, must not use it.
    plan::Quality quality = task.quality;
    frame::FrameOptions whole = frameOptions;
    whole.isAccumulated = task.samples > 1;
    whole.rows = bandsOf(session, {view, quality, frameOptions, task.samples}).front();
    session.renderer().reservePicture(view, quality, whole);
    quality.look.shading = commonShading(session, view, quality, cameras);
    PictureRequest request{view, quality, frameOptions, task.samples};
    for (int i = 0; i < task.pictures; ++i) {
        request.view.camera = cameras[static_cast<std::size_t>(i)];
        const FinishedPicture drawn = drawFinished(session, request, progress);
        request.history = drawn.frame.history;
        if (isStream)
            task.stream(render::y4mFrame(drawn.picture));
        else
            render::writePng(nameOf(i), drawn.picture, drawn.coverage);
    }
    session.tellShortfall();
}

void drawStill(const RenderTask& task, const plan::View& view, Session& session, Progress& progress) {
    const Output& output = task.output;
    const bool hasValues = output.colors.by != settings::ColorBy::None;
    for (const std::string& path : {output.picture, output.statistics, output.depth, output.shadowClasses})
        requireWritable(path); // before drawing, which can take long
    const PreparedFolder shadowDepth(output.shadowDepth);
    frame::FrameOptions options;
    options.overlay = output.overlay;
    options.wantsSurfaces = hasValues;
    options.wantsWholeMaps = !output.shadowDepth.empty();
    options.wantsWholeImage = !(output.depth + output.statistics + output.shadowClasses).empty() ||
                              output.groundTruth != validation::GroundTruth::None;
    validation::ValidationOptions validations;
    validations.measuresAliasing = !output.statistics.empty();
    validations.groundTruth = output.groundTruth;
    validations.classifiesPixels = !output.shadowClasses.empty();
    validations.comparesWithFinest = output.groundTruth != validation::GroundTruth::None;
    progress.stage("render", task.samples > 1 ? "frames" : "pictures", static_cast<std::uint64_t>(task.samples));
    FinishedPicture drawn = drawFinished(session, {view, task.quality, options, task.samples}, progress);
    session.tellShortfall();
    const std::vector<render::NamedDepths> depths = depthsOf(output, drawn.frame.plan, session.backend());
    if (hasValues) inspect::colorByValues(output.colors, session.renderer(), drawn.frame, drawn.picture);
    validation::FrameValidation proof;
    if (task.samples == 1) proof = validation::validate(session.renderer(), drawn.frame, validations);
    validation::setAccuracy(proof, drawn.frame.row);
    render::writePng(output.picture, drawn.picture, drawn.coverage);
    if (proof.classes) render::writePng(output.shadowClasses, validation::pictureOf(*proof.classes));
    for (const auto& [path, picture] : depths)
        render::writePfm(path, picture);
    if (!output.statistics.empty()) writeTextFile(output.statistics, renderRow(drawn.frame.row));
    if (task.reference)
        render::requireAlike({output.reference, *task.reference}, drawn.picture, output.referenceThreshold);
}

} // namespace

RenderTask renderTask(settings::Request request) {
    if (settings::needsMaps(request.output)) settings::askForMaps(request.settings);
    settings::requireSound(request);
    settings::readCamera(request.settings, request.output.time);
    RenderTask task;
    task.model = request.model;
    task.settings = request.settings;
    task.quality = settings::qualityOf(request.settings);
    task.output = request.output;
    task.samples = settings::samplesOf(request.output);
    if (!request.output.path.empty())
        task.path = path::projected(path::readCameraPath(request.output.path), request.settings.projection);
    if (!request.output.reference.empty()) task.reference = render::readPng(request.output.reference);
    if (request.output.isSeries())
        task.pictures = task.path ? request.output.frames.value_or(kUsualFrames) : request.output.turntable;
    task.backend = backendFor(task.settings, settings::DrawingCommand::Render, task.pictures).backend;
    return task;
}

void render(const RenderTask& task, Progress& progress) {
    Session session(task.model, task.settings, task.warn, task.backend);
    const settings::Framing framing = task.path                ? settings::Framing::Path
                                      : task.output.isSeries() ? settings::Framing::EveryTurn
                                                               : settings::Framing::OnePicture;
    const plan::View view = settings::viewOf(task.settings, session.model(), framing);
    if (task.output.isSeries())
        drawSeries(task, view, session, progress);
    else
        drawStill(task, view, session, progress);
}

} // namespace gnomon::task
