#include "measure/sun_hours_run.h"

#include "core/check.h"
#include "core/error.h"
#include "core/formatted.h"
#include "core/random.h"
#include "settings/codec.h"
#include "storage/open_source.h"

#include <utility>

namespace gnomon::measure {

namespace {

/// What of a run the model, the lights and the steps decide: a run that is resumed must have the same.
std::string keyOfRun(const SunHoursTask& task, const std::vector<daylight::SunStep>& steps) {
    const std::vector<IntegerLight> lights = daylight::lightsOf(steps);
    std::uint64_t sum = steps.size();
    for (const IntegerLight& light : lights)
        for (int axis = 0; axis < 3; ++axis)
            sum = mix64(sum ^ static_cast<std::uint64_t>(light.direction[axis]));
    return formatted(
        "model of %s; lights %zu %016llx; ",
        storage::openSource(task.model)->stamp().c_str(),
        lights.size(),
        static_cast<unsigned long long>(sum));
}

/// What a killed run leaves, beside the first of its outputs.
std::string logPathOf(const SunHoursTask& task) {
    std::string path = !task.output.empty() ? task.output : !task.pfm.empty() ? task.pfm : task.csv;
    if (path.empty()) path = task.report;
    while (path.size() > 1 && path.back() == '/')
        path.pop_back();
    GNOMON_CHECK(!path.empty());
    return path + ".steps";
}

} // namespace

std::string textOf(const glm::dvec3& point) {
    return settings::shortest(point.x) + "," + settings::shortest(point.y) + "," + settings::shortest(point.z);
}

std::string keyOfSections(const plan::View& view) {
    std::string key;
    for (const Plane& plane : view.sections)
        key += "; section " + textOf(plane.normal) + "," + settings::shortest(plane.offset);
    return key + (!view.sections.empty() && view.cutsCasters ? "; cut casters" : "");
}

std::vector<daylight::SunStep> stepsOf(const SunHoursTask& task, const glm::dvec3& up) {
    settings::SunPeriod period = task.period;
    period.up = up;
    std::vector<daylight::SunStep> steps = daylight::sunSteps(period);
    if (daylight::lightsOf(steps).empty())
        throw Error(
            "the sun is down from " + steps.front().time + " to " + steps.back().time + ": there is nothing to count");
    return steps;
}

SunHoursRun::SunHoursRun(const SunHoursTask& task, std::vector<daylight::SunStep> steps, const std::string& key)
    : farm_(*task.farm),
      threads_(task.threads),
      logPath_(logPathOf(task)),
      key_(keyOfRun(task, steps) + key),
      isResumed_(task.isResumed),
      stepSeconds_(task.period.stepSeconds),
      steps_(std::move(steps)) {}

const daylight::LitSteps* SunHoursRun::decide(daylight::Receivers& receivers, Progress& progress) {
    FarmMember self;
    self.threads = threads_;
    farm_.gather(key_ + "; receivers " + std::to_string(receivers.count()), self, progress);
    if (farm_.isLed()) {
        farm_.serve(daylight::workOf(receivers, steps_), progress);
        return nullptr;
    }
    log_.emplace(logPath_, key_, receivers.count(), daylight::lightsOf(steps_).size(), isResumed_);
    lit_ = daylight::litSteps(receivers, steps_, *log_, farm_, progress);
    return &lit_;
}

std::string SunHoursRun::time(std::uint32_t step) const {
    return step == daylight::LitSteps::kNever ? std::string() : steps_[step].time;
}

std::string SunHoursRun::row(std::size_t receiver) const {
    const std::uint32_t count = lit_.count[receiver];
    return std::to_string(count) + "," + settings::shortest(hours(count)) + "," + time(lit_.first[receiver]) + "," +
           time(lit_.last[receiver]);
}

SunHoursSummary SunHoursRun::finish(std::size_t receivers, std::string detail) {
    log_->remove();
    return {receivers, steps_.size(), lit_.stepsUp, lit_.samples, lit_.touching, std::move(detail)};
}

} // namespace gnomon::measure
