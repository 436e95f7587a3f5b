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
    /// `key` tells the receivers from others of the same model. The logs lie beside the task's first output. Throws
    /// Error.
    SunHoursRun(const SunHoursTask& task, std::vector<daylight::SunStep> steps, const std::string& key);

    const std::vector<daylight::SunStep>& steps() const { return steps_; }

    /// Decides `receivers` for all steps, in all ranks of the task's team. Steps of the logs are not decided again.
    /// Returns nothing in a rank that does not lead the team.
    const daylight::LitSteps* decide(daylight::Receivers& receivers, Progress& progress);

    /// Sets `isLit` to which receivers are lit at light `light`, by the logs; after `decide`.
    /// Throws Error if no log has its record.
    void readLit(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    double hours(std::uint32_t steps) const { return steps * stepSeconds_ / 3600; }

    /// "steps,hours,first_sun,last_sun" of a receiver.
    std::string row(std::size_t receiver) const;

    /// Ends the run: its files are written, the logs go. `detail` as SunHoursSummary has it.
    SunHoursSummary finish(std::size_t receivers, std::string detail);

private:
    std::string time(std::uint32_t step) const;

    SunHoursTeam& team_;
    std::string logStem_;
    std::string key_;
    bool isResumed_;
    double stepSeconds_;
    std::vector<daylight::SunStep> steps_;
    std::optional<daylight::LitLogs> logs_;
    daylight::LitSteps lit_;
};

/// The head of the columns that `row` writes.
inline constexpr const char* kSunHoursColumns = "steps,hours,first_sun,last_sun";

} // namespace gnomon::measure
