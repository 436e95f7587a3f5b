#include "task/sun_hours.h"

#include "core/formatted.h"
#include "core/prepared_output.h"
#include "settings/codec.h"
#include "settings/resolve.h"
#include "settings/sun_period.h"
#include "sun/sun_view.h"
#include "task/session.h"
#include "task/sun_hours_files.h"
#include "task/sun_hours_points.h"
#include "telemetry/json_text.h"

namespace gnomon::task {

namespace {

/// Returns a text that identifies which points of a model a view shows. It contains the size, the camera, the error and
/// the sections.
std::string keyOfView(const plan::View& view, const plan::Quality& quality) {
    const Camera& camera = view.camera;
    std::string key = formatted("picture %dx%d; view ", view.width, view.height) + textOf(camera.eye) + " " +
                      textOf(camera.target) + " " + textOf(camera.up) + " " + settings::shortest(camera.fovYRadians) +
                      "; error " + settings::shortest(quality.errorPixels);
    if (quality.maxTriangles) key += "; triangles " + std::to_string(*quality.maxTriangles);
    return key + keyOfSections(view);
}

void tellShortfall(
    const frame::PreparedFrame& frame,
    const plan::Quality& quality,
    const std::function<void(const std::string&)>& warn) {
    telemetry::Shortfall shortfall;
    shortfall.add(
        {quality.errorPixels,
         frame.cut.achievedErrorPixels,
         frame.residency.pagesMissing,
         frame.residency.pagesBlocked > 0});
    if (const std::string line = shortfallLine(shortfall); !line.empty()) warn(line);
}

std::optional<SunHoursSummary> computeViewHours(const SunHoursTask& task, Progress& progress) {
    const settings::Settings settings = settings::sunHoursSettings(task.settings);
    const plan::Quality quality = settings::qualityOf(settings);
    Session session(task.model, settings, task.warn);
    const plan::View view = settings::viewOf(settings, session.model());
    SunHoursRun run(task, stepsOf(task, view.up), keyOfView(view, quality));
    const bool leads = task.team->leads();
    if (leads)
        for (const std::string& path : {task.output, task.pfm, task.csv})
            requireWritable(path);
    const PreparedFolder report(leads ? task.report : std::string());
    sun::SunView receivers(session.renderer(), view, quality, sun::lightsOf(run.steps()));
    if (leads) tellShortfall(receivers.prepared(), quality, task.warn);
    const sun::LitSteps* const lit = run.decide(receivers, progress);
    if (lit == nullptr) return std::nullopt;
    const SunHoursFiles files(receivers, *lit, run, task.period);
    if (!task.output.empty()) files.writePicture(task.output);
    if (!task.pfm.empty()) files.writePfm(task.pfm);
    if (!task.csv.empty()) files.writeCsv(task.csv);
    const std::string detail = formatted("%.3g pixels", receivers.prepared().cut.achievedErrorPixels);
    if (!task.report.empty())
        files.writePage(
            task.report,
            task.model,
            {formatted(
                 "A step stands for its middle: each time the sun comes or goes the hours err by up to %g minutes.",
                 task.period.stepSeconds / 120),
             "The level of detail errs by up to " + detail + ".",
             "Shadows are exact for what was drawn; the sun is a point."});
    return run.finish(receivers.points().size(), detail);
}

} // namespace

std::optional<SunHoursSummary> computeSunHours(const SunHoursTask& task, Progress& progress) {
    return task.isOfVertices || !task.points.empty() ? computePointHours(task, progress)
                                                     : computeViewHours(task, progress);
}

std::string summaryText(const SunHoursSummary& summary, double stepSeconds) {
    return formatted(
        "%zu points, sun up in %u of %zu steps; %llu of %llu verdicts hang on the tolerance; detail errs by up to %s; "
        "each time the light comes or goes errs by up to half a step of %g s\n",
        summary.receivers,
        summary.stepsUp,
        summary.steps,
        static_cast<unsigned long long>(summary.withinTolerance),
        static_cast<unsigned long long>(summary.samples),
        summary.detail.c_str(),
        stepSeconds);
}

std::string summaryJson(const SunHoursSummary& summary) {
    const nlohmann::ordered_json json = {
        {"receivers", summary.receivers},
        {"steps", summary.steps},
        {"steps_up", summary.stepsUp},
        {"verdicts", summary.samples},
        {"touching", summary.withinTolerance},
        {"detail", summary.detail}};
    return telemetry::jsonText(json, 1);
}

} // namespace gnomon::task
