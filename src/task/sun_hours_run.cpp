#include "task/sun_hours_run.h"

#include "core/check.h"
#include "core/error.h"
#include "core/formatted.h"
#include "core/random.h"
#include "hierarchy/source/open_source.h"
#include "settings/codec.h"
#include "settings/sun_period.h"

#include <utility>

namespace gnomon::task {

namespace {

/// Returns a text that identifies the model, the time steps and the light directions of a computation. A resumed
/// computation must have the same text.
std::string keyOfRun(const SunHoursTask& task, const std::vector<sun::SunStep>& steps) {
    const std::vector<IntegerLight> lights = sun::lightsOf(steps);
    std::uint64_t sum = steps.size();
    for (const IntegerLight& light : lights)
        for (int axis = 0; axis < 3; ++axis)
            sum = mix64(sum ^ static_cast<std::uint64_t>(light.direction[axis]));
    return formatted(
        "model of %s; lights %zu %016llx; ",
        hierarchy::openSource(task.model)->stamp().c_str(),
        lights.size(),
        static_cast<unsigned long long>(sum));
}

/// Returns the path with which the names of all logs begin: the path of the first output.
std::string logStemOf(const SunHoursTask& task) {
    std::string path = !task.output.empty() ? task.output : !task.pfm.empty() ? task.pfm : task.csv;
    if (path.empty()) path = task.report;
    while (path.size() > 1 && path.back() == '/')
        path.pop_back();
    GNOMON_CHECK(!path.empty());
    return path;
}

/// Checks after each light direction whether the other processes of the job still work. The check throws an exception
/// if the job has to stop.
class PolledProgress final : public Progress {
public:
    PolledProgress(SunHoursTeam& team, Progress& progress) : team_(team), progress_(progress) {}

    void stage(std::string_view name, std::string_view unit, std::uint64_t total) override {
        progress_.stage(name, unit, total);
    }

    void advance(std::uint64_t count) override {
        progress_.advance(count);
        team_.poll();
    }

private:
    SunHoursTeam& team_;
    Progress& progress_;
};

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

std::vector<sun::SunStep> stepsOf(const SunHoursTask& task, const glm::dvec3& up) {
    sun::SunPeriod period = task.period;
    period.up = up;
    settings::requireSteps(period);
    std::vector<sun::SunStep> steps = sun::sunSteps(period);
    if (sun::lightsOf(steps).empty())
        throw Error(
            "the sun is below the horizon from " + steps.front().time + " to " + steps.back().time +
            "; choose a period with sunlight");
    return steps;
}

SunHoursRun::SunHoursRun(const SunHoursTask& task, std::vector<sun::SunStep> steps, const std::string& key)
    : team_(*task.team),
      logStem_(logStemOf(task)),
      key_(keyOfRun(task, steps) + key),
      isResumed_(task.isResumed),
      stepSeconds_(task.period.stepSeconds),
      steps_(std::move(steps)) {}

const sun::LitSteps* SunHoursRun::decide(sun::Receivers& receivers, Progress& progress) {
    team_.begin(key_ + "; receivers " + std::to_string(receivers.count()), progress);
    const sun::LightShare share = team_.share();
    logs_.emplace(logStem_, key_, receivers.count(), share, isResumed_);
    PolledProgress polled(team_, progress);
    lit_ = sun::litSteps(receivers, steps_, *logs_, share, polled);
    logs_->handOver();
    team_.combine(lit_, progress);
    if (!team_.leads()) return nullptr;
    if (share.ranks > 1) logs_->openOthers();
    return &lit_;
}

void SunHoursRun::readLit(std::size_t light, std::vector<std::uint8_t>& isLit) const {
    if (!logs_->read(light, isLit))
        throw Error(logStem_ + ".steps", "a record is missing", "light " + std::to_string(light), "nothing");
}

std::string SunHoursRun::time(std::uint32_t step) const {
    return step == sun::LitSteps::kNever ? std::string() : steps_[step].time;
}

std::string SunHoursRun::row(std::size_t receiver) const {
    const std::uint32_t count = lit_.count[receiver];
    return std::to_string(count) + "," + settings::shortest(hours(count)) + "," + time(lit_.first[receiver]) + "," +
           time(lit_.last[receiver]);
}

SunHoursSummary SunHoursRun::finish(std::size_t receivers, std::string detail) {
    logs_->remove();
    return {receivers, steps_.size(), lit_.stepsUp, lit_.samples, lit_.withinTolerance, std::move(detail)};
}

} // namespace gnomon::task
