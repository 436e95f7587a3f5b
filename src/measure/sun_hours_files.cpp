#include "measure/sun_hours_files.h"

#include "core/formatted.h"
#include "executor/overlay/legend.h"
#include "measure/text_runs.h"
#include "report/sun_page.h"
#include "settings/codec.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace gnomon::measure {

namespace {

constexpr std::uint32_t kNever = daylight::LitSteps::kNever;

executor::Rgb rgbOf(const glm::vec3& color) {
    const auto level = [](float channel) { return static_cast<std::uint8_t>(std::lround(channel * 255)); };
    return {level(color.r), level(color.g), level(color.b)};
}

std::string stepText(double seconds) {
    return seconds >= 60 ? settings::shortest(seconds / 60) + " min" : settings::shortest(seconds) + " s";
}

/// Returns the time as "2026-06-21T00:00+02:00", with seconds only if they are not 0.
std::string shortTime(const sun::CivilTime& time, int offsetMinutes) {
    std::string text = sun::written(sun::julianDate(time), offsetMinutes);
    constexpr std::size_t kSeconds = 16; // position of ":00"
    if (text.compare(kSeconds, 3, ":00") == 0) text.erase(kSeconds, 3);
    return text;
}

} // namespace

SunHoursFiles::SunHoursFiles(
    const daylight::SunView& view,
    const daylight::LitSteps& lit,
    const SunHoursRun& run,
    const settings::SunPeriod& period)
    : view_(&view), lit_(&lit), run_(&run), period_(&period), pointOf_(view.count(), kNever) {
    for (std::size_t i = 0; i < view.points().size(); ++i)
        pointOf_[view.points().pixel(i)] = static_cast<std::uint32_t>(i);
}

executor::ValueScale SunHoursFiles::scale() const {
    return {plan::ColorMap::Viridis, 0, run_->hours(std::max(lit_->stepsUp, 1U))};
}

/// Returns the picture of the view with hours as colours.
executor::Picture SunHoursFiles::coloured() const {
    executor::Picture picture = view_->picture();
    const executor::ValueScale values = scale();
    for (std::size_t i = 0; i < pointOf_.size(); ++i)
        if (pointOf_[i] != kNever) picture.pixels[i] = rgbOf(values.color(run_->hours(lit_->count[i])));
    return picture;
}

std::string SunHoursFiles::periodText() const {
    const int offset = period_->from.offsetMinutes;
    return shortTime(period_->from, offset) + " to " + shortTime(period_->to, offset) + ", steps of " +
           stepText(period_->stepSeconds);
}

void SunHoursFiles::writePicture(const std::string& path) const {
    executor::Picture picture = coloured();
    executor::Legend legend;
    legend.title = {"hours of sun, " + periodText()};
    legend.scale = executor::colorScale(scale());
    executor::drawLegend(picture, legend);
    executor::writePng(path, picture);
}

void SunHoursFiles::writePage(
    const std::string& folder, const std::string& model, const std::vector<std::string>& errors) const {
    constexpr std::size_t kMostSteps = 400;
    constexpr int kColors = 17;
    const executor::Picture picture = coloured();
    report::SunPage page;
    page.about = formatted(
                     "%s, %g degrees north, %g degrees east, ",
                     std::filesystem::path(model).filename().c_str(),
                     period_->place.latitude,
                     period_->place.longitude) +
                 periodText();
    page.errors = errors;
    page.width = picture.width;
    page.height = picture.height;
    page.picture = executor::pngBytes(picture);
    const executor::ColorScale shown = executor::colorScale(scale());
    for (int i = 0; i < kColors; ++i) {
        const executor::Rgb color = rgbOf(shown.color(static_cast<float>(i) / (kColors - 1)));
        page.colors.push_back(formatted("#%02x%02x%02x", color[0], color[1], color[2]));
    }
    for (const executor::ColorScale::Tick& tick : shown.ticks)
        page.figures.push_back({tick.place, tick.text});
    std::vector<std::uint8_t> isLit;
    const std::size_t stride = (lit_->stepsUp + kMostSteps - 1) / kMostSteps;
    std::size_t light = 0;
    for (const daylight::SunStep& step : run_->steps()) {
        if (!step.isUp || light++ % stride != 0) continue;
        run_->readLit(light - 1, isLit);
        for (std::size_t i = 0; i < pointOf_.size(); ++i)
            if (pointOf_[i] == kNever) isLit[i] = 1;
        page.steps.push_back({step.time, report::litRuns(isLit)});
    }
    writeTextFile((std::filesystem::path(folder) / "index.html").string(), report::sunPage(page));
}

void SunHoursFiles::writePfm(const std::string& path) const {
    executor::FloatPicture result(view_->picture().width, view_->picture().height, -1.0F);
    for (std::size_t i = 0; i < pointOf_.size(); ++i)
        if (pointOf_[i] != kNever) result.pixels[i] = static_cast<float>(run_->hours(lit_->count[i]));
    executor::writePfm(path, result);
}

void SunHoursFiles::writeCsv(const std::string& path) const {
    TextRuns out(path);
    out.put(std::string("column,row,x,y,z,") + kSunHoursColumns + "\n");
    const auto width = static_cast<std::size_t>(view_->picture().width);
    for (std::size_t i = 0; i < pointOf_.size(); ++i) {
        if (pointOf_[i] == kNever) continue;
        out.put(
            formatted("%zu,%zu,", i % width, i / width) + textOf(view_->position(pointOf_[i])) + "," + run_->row(i) +
            "\n");
    }
    out.commit();
}

} // namespace gnomon::measure
