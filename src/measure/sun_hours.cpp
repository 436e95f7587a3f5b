#include "measure/sun_hours.h"

#include "core/check.h"
#include "core/error.h"
#include "core/file.h"
#include "core/formatted.h"
#include "core/prepared_output.h"
#include "core/random.h"
#include "daylight/sun_hours.h"
#include "daylight/sun_view.h"
#include "measure/session.h"
#include "measure/sun_hours_files.h"
#include "settings/codec.h"
#include "settings/resolve.h"

#include <utility>

namespace gnomon::measure {

namespace {

using settings::shortest;

std::string text(const glm::dvec3& v) {
    return shortest(v.x) + "," + shortest(v.y) + "," + shortest(v.z);
}

/// What is computed from what: a run that is resumed must have the same.
std::string keyOf(const SunHoursTask& task, const plan::View& view, const std::vector<IntegerLight>& lights) {
    const File model(task.model, File::Mode::Read);
    std::uint64_t sum = lights.size();
    for (const IntegerLight& light : lights)
        for (int axis = 0; axis < 3; ++axis)
            sum = mix64(sum ^ static_cast<std::uint64_t>(light.direction[axis]));
    const Camera& camera = view.camera;
    return formatted(
               "model of %llu bytes, changed at %lld; lights %zu %016llx; picture %dx%d; error %s; view ",
               static_cast<unsigned long long>(model.size()),
               static_cast<long long>(model.changeTime()),
               lights.size(),
               static_cast<unsigned long long>(sum),
               view.width,
               view.height,
               shortest(task.settings.quality.errorPixels).c_str()) +
           text(camera.eye) + " " + text(camera.target) + " " + text(camera.up) + " " + shortest(camera.fovYRadians) +
           (task.settings.quality.maxTriangles
                ? formatted("; triangles %llu", static_cast<unsigned long long>(*task.settings.quality.maxTriangles))
                : "");
}

/// What a killed run leaves, beside the first of its outputs.
std::string logPath(const SunHoursTask& task) {
    std::string path = task.output.empty() ? task.pfm.empty() ? task.csv : task.pfm : task.output;
    GNOMON_CHECK(!path.empty());
    return path + ".steps";
}

} // namespace

SunHoursSummary computeSunHours(const SunHoursTask& task, Progress& progress) {
    const std::string logFile = logPath(task);
    const settings::Settings settings = settings::sunHoursSettings(task.settings);
    const plan::Quality quality = settings::qualityOf(settings);
    Session session(task.model, settings, task.warn);
    const plan::View view = settings::viewOf(settings, session.model());
    settings::SunPeriod period = task.period;
    period.up = view.up;
    const std::vector<daylight::SunStep> steps = daylight::sunSteps(period);
    const std::vector<IntegerLight> lights = daylight::lightsOf(steps);
    if (lights.empty())
        throw Error(
            "the sun is down from " + steps.front().time + " to " + steps.back().time + ": there is nothing to count");
    for (const std::string& path : {task.output, task.pfm, task.csv})
        requireWritable(path);
    daylight::SunView receivers(session.renderer(), view, quality, lights);
    daylight::LitLog log(logFile, keyOf(task, view, lights), receivers.count(), task.isResumed);
    const daylight::LitSteps lit = daylight::litSteps(receivers, steps, log, progress);
    const SunHoursFiles files(receivers, lit, steps, period);
    if (!task.output.empty()) files.writePicture(task.output);
    if (!task.pfm.empty()) files.writePfm(task.pfm);
    if (!task.csv.empty()) files.writeCsv(task.csv);
    log.remove();
    return {
        receivers.points().size(),
        steps.size(),
        lit.stepsUp,
        lit.samples,
        lit.touching,
        receivers.achievedErrorPixels()};
}

} // namespace gnomon::measure
