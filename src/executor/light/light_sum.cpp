#include "executor/light/light_sum.h"

#include "core/check.h"
#include "executor/light/background.h"
#include "executor/light/light_model.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::executor {

namespace {

constexpr double kLightSteps = 1 << 20; // of full scale
constexpr float kBrightest = 4096;
constexpr std::size_t kGrain = 16384;

template <class Work>
void forAllPixels(std::size_t pixels, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, kGrain), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            work(i);
    });
}

std::uint64_t lightSteps(float light) {
    // What is no number is as bright as can be: it shows.
    const float bounded = light < kBrightest ? std::max(light, 0.0F) : kBrightest;
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(bounded) * kLightSteps));
}

/// The nearest of a screen's levels, as single frames have it.
std::uint8_t screenLevel(float linear) {
    return static_cast<std::uint8_t>(
        (static_cast<int>(510 * std::clamp(displayFromLinear(linear), 0.0F, 1.0F)) + 1) / 2);
}

} // namespace

Shown shownAs(const FrameDrawing& frame) {
    Shown shown;
    shown.isShouldered = frame.shading != plan::Shading::Unlit;
    shown.isTransparent = frame.plan->quality.look.background.kind == plan::Background::Kind::Transparent;
    shown.backgroundRows = backgroundRows(frame);
    return shown;
}

void addLight(LightPicture& light, const LightPicture& other) {
    GNOMON_CHECK(light.width == other.width && light.height == other.height);
    forAllPixels(light.pixels.size(), [&](std::size_t i) {
        if (light.pixels[i][0] < 0 || other.pixels[i][0] < 0) return;
        for (std::size_t c = 0; c < 3; ++c)
            light.pixels[i][c] += other.pixels[i][c];
    });
}

void LightSum::reset() {
    count_ = 0;
}

void LightSum::add(const LightPicture& light) {
    GNOMON_CHECK(count_ < kMost);
    if (count_ == 0) {
        sums_ = Raster<Sums>(light.width, light.height);
        covered_ = Raster<std::uint16_t>(light.width, light.height);
    }
    GNOMON_CHECK(light.width == sums_.width && light.height == sums_.height);
    forAllPixels(light.pixels.size(), [&](std::size_t i) {
        const std::array<float, 3>& pixel = light.pixels[i];
        if (pixel[0] < 0) return;
        ++covered_.pixels[i];
        for (std::size_t c = 0; c < 3; ++c)
            sums_.pixels[i][c] += lightSteps(pixel[c]);
    });
    ++count_;
}

LightPicture LightSum::mean() const {
    LightPicture mean(sums_.width, sums_.height, {-1, -1, -1});
    forAllPixels(mean.pixels.size(), [&](std::size_t i) {
        if (covered_.pixels[i] == 0) return;
        for (std::size_t c = 0; c < 3; ++c)
            mean.pixels[i][c] =
                static_cast<float>(static_cast<double>(sums_.pixels[i][c]) / (covered_.pixels[i] * kLightSteps));
    });
    return mean;
}

Picture LightSum::picture(const Shown& shown) const {
    GNOMON_CHECK(count_ > 0);
    GNOMON_CHECK(shown.backgroundRows.size() == static_cast<std::size_t>(sums_.height));
    block::Frame curve{};
    curve.isShouldered = shown.isShouldered ? 1 : 0;
    const LightPicture mean = this->mean();
    Picture picture(sums_.width, sums_.height);
    forAllPixels(picture.pixels.size(), [&](std::size_t i) {
        const Rgb& behind = shown.backgroundRows[i / static_cast<std::size_t>(sums_.width)];
        const int covered = covered_.pixels[i];
        if (covered == 0) {
            picture.pixels[i] = shown.isTransparent ? Rgb{} : behind;
            return;
        }
        const bool isMixed = covered < count_ && !shown.isTransparent;
        const float share = static_cast<float>(covered) / static_cast<float>(count_);
        for (std::size_t c = 0; c < 3; ++c) {
            float linear = shoulder(curve, mean.pixels[i][c]);
            if (isMixed) linear = share * linear + (1 - share) * linearFromDisplay(static_cast<float>(behind[c]) / 255);
            picture.pixels[i][c] = screenLevel(linear);
        }
    });
    return picture;
}

Coverage LightSum::coverage() const {
    const auto count = static_cast<std::uint32_t>(count_);
    Coverage coverage(covered_.width, covered_.height);
    forAllPixels(coverage.pixels.size(), [&](std::size_t i) {
        coverage.pixels[i] = static_cast<std::uint8_t>((255 * std::uint32_t{covered_.pixels[i]} + count / 2) / count);
    });
    return coverage;
}

} // namespace gnomon::executor
