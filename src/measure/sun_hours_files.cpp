#include "measure/sun_hours_files.h"

#include "core/file.h"
#include "core/formatted.h"
#include "executor/overlay/legend.h"
#include "settings/codec.h"

#include <algorithm>

namespace gnomon::measure {

namespace {

constexpr std::uint32_t kNever = daylight::LitSteps::kNever;

/// A text file that is written in runs, complete or not at all.
class TextRuns {
public:
    explicit TextRuns(const std::string& path) : file_(path) {}

    void put(const std::string& line) {
        text_ += line;
        constexpr std::size_t kRun = std::size_t{1} << 20U;
        if (text_.size() >= kRun) flush();
    }

    void commit() {
        flush();
        file_.commit();
    }

private:
    void flush() {
        file_.file().writeAt(offset_, std::as_bytes(std::span(text_)));
        offset_ += text_.size();
        text_.clear();
    }

    AtomicFile file_;
    std::uint64_t offset_ = 0;
    std::string text_;
};

executor::Rgb rgbOf(const glm::vec3& color) {
    const auto level = [](float channel) { return static_cast<std::uint8_t>(std::lround(channel * 255)); };
    return {level(color.r), level(color.g), level(color.b)};
}

std::string stepText(double seconds) {
    return seconds >= 60 ? settings::shortest(seconds / 60) + " min" : settings::shortest(seconds) + " s";
}

/// "2026-06-21T00:00+02:00", its seconds only where there are any.
std::string shortTime(const sun::CivilTime& time, int offsetMinutes) {
    std::string text = sun::written(sun::julianDate(time), offsetMinutes);
    constexpr std::size_t kSeconds = 16; // where ":00" begins
    if (text.compare(kSeconds, 3, ":00") == 0) text.erase(kSeconds, 3);
    return text;
}

} // namespace

SunHoursFiles::SunHoursFiles(
    const daylight::SunView& view,
    const daylight::LitSteps& lit,
    const std::vector<daylight::SunStep>& steps,
    const settings::SunPeriod& period)
    : view_(&view), lit_(&lit), steps_(&steps), period_(&period), pointOf_(view.count(), kNever) {
    for (std::size_t i = 0; i < view.points().size(); ++i)
        pointOf_[view.points().pixel(i)] = static_cast<std::uint32_t>(i);
}

void SunHoursFiles::writePicture(const std::string& path) const {
    executor::Picture picture = view_->picture();
    const executor::ValueScale values{plan::ColorMap::Viridis, 0, hours(std::max(lit_->stepsUp, 1U))};
    for (std::size_t i = 0; i < pointOf_.size(); ++i)
        if (pointOf_[i] != kNever) picture.pixels[i] = rgbOf(values.color(hours(lit_->count[i])));
    executor::Legend legend;
    const int offset = period_->from.offsetMinutes;
    legend.title = {
        "hours of sun, " + shortTime(period_->from, offset) + " to " + shortTime(period_->to, offset) + ", steps of " +
        stepText(period_->stepSeconds)};
    legend.scale = executor::colorScale(values);
    executor::drawLegend(picture, legend);
    executor::writePng(path, picture);
}

void SunHoursFiles::writePfm(const std::string& path) const {
    executor::FloatPicture result(view_->picture().width, view_->picture().height, -1.0F);
    for (std::size_t i = 0; i < pointOf_.size(); ++i)
        if (pointOf_[i] != kNever) result.pixels[i] = static_cast<float>(hours(lit_->count[i]));
    executor::writePfm(path, result);
}

void SunHoursFiles::writeCsv(const std::string& path) const {
    TextRuns out(path);
    out.put("column,row,x,y,z,steps,hours,first_sun,last_sun\n");
    const auto width = static_cast<std::size_t>(view_->picture().width);
    const auto time = [this](std::uint32_t step) { return step == kNever ? std::string() : (*steps_)[step].time; };
    for (std::size_t i = 0; i < pointOf_.size(); ++i) {
        if (pointOf_[i] == kNever) continue;
        const glm::dvec3 p = view_->position(pointOf_[i]);
        out.put(
            formatted("%zu,%zu,", i % width, i / width) + settings::shortest(p.x) + "," + settings::shortest(p.y) +
            "," + settings::shortest(p.z) + formatted(",%u,", lit_->count[i]) +
            settings::shortest(hours(lit_->count[i])) + "," + time(lit_->first[i]) + "," + time(lit_->last[i]) + "\n");
    }
    out.commit();
}

} // namespace gnomon::measure
