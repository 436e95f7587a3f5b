// What hours of sun of a view and of points have in common: the steps, and the run through them beside its log.
#pragma once

#include "daylight/sun_hours.h"
#include "measure/sun_hours_task.h"
#include "plan/frame_plan.h"

namespace gnomon::measure {

/// "x,y,z", each the shortest text that reads back as its number.
std::string textOf(const glm::dvec3& point);

/// The steps of a task's period in a world in which `up` is up. Throws Error if the Sun is down in all of them.
std::vector<daylight::SunStep> stepsOf(const SunHoursTask& task, const glm::dvec3& up);

/// What tells the sections of a view from others; empty without any.
std::string keyOfSections(const plan::View& view);

/// One run through all steps.
class SunHoursRun {
public:
    /// `key` tells the receivers from others of the same model. The log lies beside the task's first output. Throws
    /// Error.
    SunHoursRun(const SunHoursTask& task, std::vector<daylight::SunStep> steps, const std::string& key);

    const std::vector<daylight::SunStep>& steps() const { return steps_; }

    /// Decides `receivers` for all steps, in all processes of the task's farm; those of the log are not decided again.
    /// Nothing in a process that another one leads: it has helped.
    const daylight::LitSteps* decide(daylight::Receivers& receivers, Progress& progress);

    /// Sets `isLit` to which receivers are lit at light `light`, by the log; after `decide`.
    void readLit(std::size_t light, std::vector<std::uint8_t>& isLit) const { log_->read(light, isLit); }

    double hours(std::uint32_t steps) const { return steps * stepSeconds_ / 3600; }

    /// "steps,hours,first_sun,last_sun" of a receiver.
    std::string row(std::size_t receiver) const;

    /// Ends the run: its files are written, the log goes. `detail` as SunHoursSummary has it.
    SunHoursSummary finish(std::size_t receivers, std::string detail);

private:
    std::string time(std::uint32_t step) const;

    TaskFarm& farm_;
    std::uint32_t threads_;
    std::string logPath_;
    std::string key_;
    bool isResumed_;
    double stepSeconds_;
    std::vector<daylight::SunStep> steps_;
    std::optional<daylight::LitLog> log_;
    daylight::LitSteps lit_;
};

/// The head of the columns that `row` writes.
inline constexpr const char* kSunHoursColumns = "steps,hours,first_sun,last_sun";

} // namespace gnomon::measure
