// Writes the sun hours of an image: as a picture, PFM, CSV and HTML page.
#pragma once

#include "render/overlay/legend.h"
#include "sun/sun_view.h"
#include "task/sun_hours_run.h"

#include <string>

namespace gnomon::task {

/// Writes the output files of a sun hours computation. All arguments of the constructor must outlive the object. Each
/// file appears when it is complete. All functions that write throw Error.
class SunHoursFiles {
public:
    SunHoursFiles(
        const sun::SunView& view, const sun::LitSteps& lit, const SunHoursRun& run, const sun::SunPeriod& period);

    /// Writes a PNG that shows the sun hours as colours, with a legend. The colour scale goes from 0 to the hours in
    /// which the Sun is above the horizon.
    void writePicture(const std::string& path) const;

    /// Writes the sun hours of each pixel as a PFM. Pixels of the background are -1.
    void writePfm(const std::string& path) const;

    /// Writes a CSV with one row per pixel that shows the model. A row contains column and row from the upper left, the
    /// point in the coordinates of the source, and the number of time steps and of hours with sun. The last two columns
    /// are the times of the first and the last step with sun (the middle of the step).
    void writeCsv(const std::string& path) const;

    /// Writes index.html, which shows the sun hours as colours, with a slider over the times of day. Surfaces in shadow
    /// at the chosen time are darker. The slider has at most 400 of the time steps in which the Sun is above the
    /// horizon, evenly chosen. `errors` are sentences about the errors of the hours.
    void writePage(const std::string& folder, const std::string& model, const std::vector<std::string>& errors) const;

private:
    render::ValueScale scale() const;
    render::Picture coloured() const;
    std::string periodText() const;

    const sun::SunView* view_;
    const sun::LitSteps* lit_;
    const SunHoursRun* run_;
    const sun::SunPeriod* period_;
    std::vector<std::uint32_t> pointOf_; // receiver of each pixel; kNever for the background
};

} // namespace gnomon::task
