#include "task/sun_hours_files.h"

#include "core/formatted.h"
#include "render/overlay/legend.h"
#include "report/sun_page.h"
#include "settings/codec.h"
#include "task/text_runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace gnomon::task {

namespace {

constexpr std::uint32_t kNever = sun::LitSteps::kNever;

render::Rgb rgbOf(const glm::vec3& color) {
    const auto level = [](float channel) { return static_cast<std::uint8_t>(std::lround(channel * 255)); };
    return {level(color.r), level(color.g), level(color.b)};
}

std::string stepText(double seconds) {
    return seconds >= 60 ? settings::shortest(seconds / 60) + " min" : settings::shortest(seconds) + " s";
}

/// Returns a time as "2026-06-21T00:00+02:00", with seconds only if they are not 0.
std::string shortTime(const sun::CivilTime& time, int offsetMinutes) {
    std::string text = sun::written(sun::julianDate(time), offsetMinutes);
    constexpr std::size_t kSeconds = 16; // position of ":00"
    if (text.compare(kSeconds, 3, ":00") == 0) text.erase(kSeconds, 3);
    return text;
}

} // namespace

SunHoursFiles::SunHoursFiles(
    const sun::SunView& view, const sun::LitSteps& lit, const SunHoursRun& run, const sun::SunPeriod& period)
    : view_(&view), lit_(&lit), run_(&run), period_(&period), pointOf_(view.count(), kNever) {
    for (std::size_t i = 0; i < view.points().size(); ++i)
        pointOf_[view.points().pixel(i)] = static_cast<std::uint32_t>(i);
}

render::ValueScale SunHoursFiles::scale() const {
    return {plan::ColorMap::Viridis, 0, run_->hours(std::max(lit_->stepsUp, 1U))};
}

/// Returns the image of the view in which colours show the hours of sun.
render::Picture SunHoursFiles::coloured() const {
    render::Picture picture = view_->picture();
    const render::ValueScale values = scale();
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
    render::Picture picture = coloured();
    render::Legend legend;
    legend.title = {"hours of sun, " + periodText()};
    legend.scale = render::colorScale(scale());
    render::drawLegend(picture, legend);
    render::writePng(path, picture);
}

void SunHoursFiles::writePage(
    const std::string& folder, const std::string& model, const std::vector<std::string>& errors) const {
    constexpr std::size_t kMaxSteps = 400;
    constexpr int kColors = 17;
    const render::Picture picture = coloured();
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
    page.picture = render::pngBytes(picture);
    const render::ColorScale shown = render::colorScale(scale());
    for (int i = 0; i < kColors; ++i) {
        const render::Rgb color = rgbOf(shown.color(static_cast<float>(i) / (kColors - 1)));
        page.colors.push_back(formatted("#%02x%02x%02x", color[0], color[1], color[2]));
    }
    for (const render::ColorScale::Tick& tick : shown.ticks)
        page.figures.push_back({tick.place, tick.text});
    std::vector<std::uint8_t> isLit;
    const std::size_t stride = (lit_->stepsUp + kMaxSteps - 1) / kMaxSteps;
    std::size_t light = 0;
    for (const sun::SunStep& step : run_->steps()) {
        if (!step.isUp || light++ % stride != 0) continue;
        run_->readLit(light - 1, isLit);
        for (std::size_t i = 0; i < pointOf_.size(); ++i)
            if (pointOf_[i] == kNever) isLit[i] = 1;
        page.steps.push_back({step.time, report::litRuns(isLit)});
    }
    writeTextFile((std::filesystem::path(folder) / "index.html").string(), report::sunPage(page));
}

void SunHoursFiles::writePfm(const std::string& path) const {
    render::FloatPicture result(view_->picture().width, view_->picture().height, -1.0F);
    for (std::size_t i = 0; i < pointOf_.size(); ++i)
        if (pointOf_[i] != kNever) result.pixels[i] = static_cast<float>(run_->hours(lit_->count[i]));
    render::writePfm(path, result);
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

} // namespace gnomon::task
