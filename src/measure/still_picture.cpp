#include "measure/still_picture.h"

#include "core/file.h"
#include "core/prepared_output.h"
#include "executor/shadow_depth_files.h"
#include "measure/finished_picture.h"
#include "settings/picture_series.h"
#include "settings/resolve.h"
#include "settings/samples.h"
#include "telemetry/process_clock.h"
#include "values/value_picture.h"

namespace gnomon::measure {

namespace {

/// Returns the options of the task that restrict the number of frames.
settings::BesideSamples besideSamples(const StillTask& task) {
    settings::BesideSamples beside;
    beside.overlay = task.overlay != executor::Overlay::None;
    beside.sunAngle = task.settings.sunAngleDegrees.value_or(0) > 0;
    beside.sky = task.settings.quality.sky.directions > 0;
    beside.values = task.colors.by != settings::ColorBy::None;
    beside.statistics = !task.statistics.empty();
    beside.oracle = task.oracle != proof::Oracle::None;
    beside.depth = !task.depth.empty();
    beside.shadowDepth = !task.shadowDepth.empty();
    beside.reference = !task.reference.empty();
    return beside;
}

void setAccuracy(const StillTask& task, Session& session, frame::Frame& frame) {
    proof::ProofOptions options;
    options.measuresAliasing = !task.statistics.empty();
    options.oracle = task.oracle;
    options.comparesWithFinest = options.oracle != proof::Oracle::None;
    proof::setAccuracy(proof::prove(session.renderer(), frame, options), frame.row);
}

void writeRow(const StillTask& task, telemetry::FrameRow row) {
    row.run = "render";
    row.sinceStartMs = telemetry::sinceProcessStart().count;
    writeTextFile(task.statistics, telemetry::jsonObject(row) + "\n");
}

} // namespace

void drawStill(const StillTask& task, Progress& progress) {
    const settings::BesideSamples beside = besideSamples(task);
    const int samples = settings::samplesOf(task.samples, beside);
    const plan::Quality quality = settings::qualityOf(task.settings);
    settings::requireLegendShown(task.settings, beside.overlay || beside.values);
    settings::requireCapable(task.settings, task.colors);
    Session session(task.model, task.settings, task.warn);
    plan::View view = settings::viewOf(task.settings, session.model());
    view.camera = task.camera.value_or(view.camera);
    std::optional<executor::Picture> reference;
    if (!task.reference.empty()) reference = executor::readPng(task.reference);
    for (const std::string& path : {task.output, task.statistics, task.depth})
        requireWritable(path); // fails before the long drawing
    const PreparedFolder shadowDepth(task.shadowDepth);
    frame::FrameOptions options;
    options.overlay = task.overlay;
    options.wantsSurfaces = beside.values;
    options.wantsWholeMaps = !task.shadowDepth.empty();
    options.wantsWholeImage = beside.depth || beside.statistics || beside.oracle;
    progress.stage("render", samples > 1 ? "frames" : "pictures", static_cast<std::uint64_t>(samples));
    FinishedPicture drawn = drawFinished(session, view, quality, options, samples, progress);
    session.tellShortfall();
    if (beside.values) values::colorByValues(task.colors, session.renderer(), drawn.frame, drawn.picture);
    if (samples == 1) setAccuracy(task, session, drawn.frame);
    executor::writePng(task.output, drawn.picture, drawn.coverage);
    if (!task.depth.empty()) executor::writePfm(task.depth, session.executor().viewDepth());
    if (!task.shadowDepth.empty()) executor::writeShadowMaps(task.shadowDepth, drawn.frame.plan, session.executor());
    if (!task.statistics.empty()) writeRow(task, drawn.frame.row);
    if (reference) executor::requireAlike({task.reference, *reference}, drawn.picture, task.referenceThreshold);
}

} // namespace gnomon::measure
