// Runs a sun hours computation over all time steps, for the pixels of an image or for points. A log makes it
// resumable.
#pragma once

#include "plan/frame_plan.h"
#include "sun/sun_hours.h"
#include "task/sun_hours_task.h"

namespace gnomon::task {

/// Returns a point as "x,y,z". Each number has the shortest text that reads back as the same value.
std::string textOf(const glm::dvec3& point);

/// Returns the time steps in the period of the task, with the direction of the Sun in a world whose up direction is
/// `up`. Throws Error if the Sun is below the horizon in all steps.
std::vector<sun::SunStep> stepsOf(const SunHoursTask& task, const glm::dvec3& up);

/// Returns a text that identifies the section planes of a view, for the key of a log. It is empty for a view without
/// sections.
std::string keyOfSections(const plan::View& view);

/// Tests points of a model for sunlight in all time steps of a period.
class SunHoursRun {
public:
    /// Starts a computation. `key` identifies the tested points within the model. The logs are in the folder of the
    /// first output of the task. Throws Error.
    SunHoursRun(const SunHoursTask& task, std::vector<sun::SunStep> steps, const std::string& key);

    const std::vector<sun::SunStep>& steps() const { return steps_; }

    /// Tests the points `receivers` for sunlight in all time steps, together with all processes of the task's team.
    /// Steps that the logs already contain are read from there. Returns nullptr in all ranks except rank 0. The result
    /// is valid while this object exists.
    const sun::LitSteps* decide(sun::Receivers& receivers, Progress& progress);

    /// Reads from the logs which receivers the light direction `light` reaches, and sets `isLit` to 0 or 1 per
    /// receiver. Must be called after `decide`. Throws Error if no log contains this light.
    void readLit(std::size_t light, std::vector<std::uint8_t>& isLit) const;

    double hours(std::uint32_t steps) const { return steps * stepSeconds_ / 3600; }

    /// Returns the sun hours of one receiver (a tested point) as a CSV row with the columns kSunHoursColumns.
    std::string row(std::size_t receiver) const;

    /// Removes the logs and returns the summary of the computation. Must be called after all output files are complete.
    /// `detail` is SunHoursSummary::detail.
    SunHoursSummary finish(std::size_t receivers, std::string detail);

private:
    std::string time(std::uint32_t step) const;

    SunHoursTeam& team_;
    std::string logStem_;
    std::string key_;
    bool isResumed_;
    double stepSeconds_;
    std::vector<sun::SunStep> steps_;
    std::optional<sun::LitLogs> logs_;
    sun::LitSteps lit_;
};

/// The header of the CSV columns that `row` returns.
inline constexpr const char* kSunHoursColumns = "steps,hours,first_sun,last_sun";

} // namespace gnomon::task
