// The hours of sun of a view as files.
#pragma once

#include "daylight/sun_view.h"
#include "executor/overlay/legend.h"
#include "measure/sun_hours_run.h"

#include <string>

namespace gnomon::measure {

/// What was computed; all must outlive it. Every file appears when it is complete. Throws Error.
class SunHoursFiles {
public:
    SunHoursFiles(
        const daylight::SunView& view,
        const daylight::LitSteps& lit,
        const SunHoursRun& run,
        const settings::SunPeriod& period);

    /// A PNG, from no hours to all that the Sun is up, with its legend.
    void writePicture(const std::string& path) const;

    /// Hours; -1 where nothing is.
    void writePfm(const std::string& path) const;

    /// A row for each pixel that sees the model, from the upper left on: column and row from there, the point in the
    /// source's coordinates, steps and hours with sun, the middle of the first and of the last of these steps.
    void writeCsv(const std::string& path) const;

    /// index.html: hours as colours, darkened where the Sun does not reach at the time that a slider names; up to 400
    /// of the steps in which it is up, evenly taken. `errors` are sentences on what the hours are off by.
    void writePage(const std::string& folder, const std::string& model, const std::vector<std::string>& errors) const;

private:
    executor::ValueScale scale() const;
    executor::Picture coloured() const;
    std::string periodText() const;

    const daylight::SunView* view_;
    const daylight::LitSteps* lit_;
    const SunHoursRun* run_;
    const settings::SunPeriod* period_;
    std::vector<std::uint32_t> pointOf_; // by pixel; kNever where nothing is
};

} // namespace gnomon::measure
