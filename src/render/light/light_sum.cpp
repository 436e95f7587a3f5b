#include "render/light/light_sum.h"

#include "core/check.h"
#include "render/light/background.h"
#include "render/light/light_model.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

constexpr double kLightSteps = 1 << 20; // units of the sums per full scale
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
    // NaN becomes the max brightness, so that errors are visible.
    const float bounded = light < kBrightest ? std::max(light, 0.0F) : kBrightest;
    return static_cast<std::uint64_t>(std::llround(static_cast<double>(bounded) * kLightSteps));
}

/// Converts linear light to the nearest of the 8-bit levels of a screen. The rounding is the same as for single frames.
std::uint8_t screenLevel(float linear) {
    return static_cast<std::uint8_t>(
        (static_cast<int>(510 * std::clamp(displayFromLinear(linear), 0.0F, 1.0F)) + 1) / 2);
}

} // namespace

ToneMapping toneMappingOf(const DrawInputs& frame) {
    ToneMapping shown;
    shown.isToneMapped = frame.shading != plan::Shading::Unlit;
    shown.isTransparent = frame.plan->quality.look.background.kind == plan::Background::Kind::Transparent;
    shown.hasGround = frame.ground != nullptr;
    shown.backgroundRows = backgroundRows(frame);
    return shown;
}

void addLight(LightPicture& light, const LightPicture& other) {
    GNOMON_CHECK(light.width == other.width && light.height == other.height);
    forAllPixels(light.pixels.size(), [&](std::size_t i) {
        const bool isSurface = light.pixels[i][0] >= 0;
        if (isSurface != (other.pixels[i][0] >= 0)) return;
        for (std::size_t c = 0; c < 3; ++c)
            light.pixels[i][c] += isSurface ? other.pixels[i][c] : 1 + other.pixels[i][c];
    });
}

Bytes LightSum::bytes(std::uint64_t pixels, bool hasGround, bool hasSky) {
    constexpr std::uint64_t kLight = sizeof(LightPicture::pixels[0]);
    constexpr std::uint64_t kHeld = sizeof(Sums) + sizeof(std::uint16_t) + kLight;
    // Bytes per pixel of the finished light and picture. A temporary copy of the light of one frame needs no more.
    constexpr std::uint64_t kShown = kLight + sizeof(Rgb);
    const std::uint64_t ofGround = hasGround ? sizeof(Sums) : 0;
    const std::uint64_t ofSky = hasSky ? kLight : 0;
    return {pixels * (kHeld + kShown + ofGround + ofSky)};
}

void LightSum::reset(bool hasGround, int firstRow) {
    firstRow_ = firstRow;
    sums_ = shadows_ = {};
    covered_ = {};
    count_ = whole_ = 0;
    tiles_.reset();
    hasGround_ = hasGround;
}

void LightSum::addPixel(std::size_t i, const std::array<float, 3>& pixel) {
    if (pixel[0] < 0) {
        if (hasGround_)
            for (std::size_t c = 0; c < 3; ++c)
                shadows_.pixels[i][c] += lightSteps((1 + pixel[c]) / kGroundShade);
        return;
    }
    ++covered_.pixels[i];
    for (std::size_t c = 0; c < 3; ++c)
        sums_.pixels[i][c] += lightSteps(pixel[c]);
}

void LightSum::add(const LightPicture& light, const shadow::TileMask* tiles) {
    GNOMON_CHECK(count_ < kMaxPictures);
    if (count_ == 0) {
        sums_ = Raster<Sums>(light.width, light.height);
        covered_ = Raster<std::uint16_t>(light.width, light.height);
        shadows_ = hasGround_ ? Raster<Sums>(light.width, light.height) : Raster<Sums>();
    }
    GNOMON_CHECK(light.width == sums_.width && light.height == sums_.height);
    GNOMON_CHECK(!tiles_ || (tiles != nullptr && *tiles == *tiles_));
    if (tiles == nullptr) {
        forAllPixels(light.pixels.size(), [&](std::size_t i) { addPixel(i, light.pixels[i]); });
        whole_ = ++count_;
        return;
    }
    if (!tiles_) tiles_ = *tiles;
    tbb::parallel_for(0, light.height, [&](int row) {
        for (int x = 0; x < light.width; x += shadow::ImageTiles::kSide) {
            if (!tiles->holds(x, firstRow_ + light.height - 1 - row)) continue;
            const int end = std::min(x + shadow::ImageTiles::kSide, light.width);
            for (std::size_t i = light.index(x, row); i < light.index(end, row); ++i)
                addPixel(i, light.pixels[i]);
        }
    });
    ++count_;
}

/// Returns the number of frames that contain pixel `i`.
int LightSum::framesOf(std::size_t i) const {
    if (!tiles_) return count_;
    const auto width = static_cast<std::size_t>(sums_.width);
    const int row = static_cast<int>(i / width);
    return tiles_->holds(static_cast<int>(i % width), firstRow_ + sums_.height - 1 - row) ? count_ : whole_;
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

/// Returns the fraction of the background's light that remains at pixel `i` in ground shadows, per channel. The
/// fraction is the mean over the frames in which the pixel shows the background, or 1 if there are none.
std::array<float, 3> LightSum::leftOfBackground(std::size_t i) const {
    std::array<float, 3> left = {1, 1, 1};
    const int open = framesOf(i) - covered_.pixels[i];
    if (!hasGround_ || open == 0) return left;
    for (std::size_t c = 0; c < 3; ++c)
        left[c] =
            static_cast<float>(std::max(1 - static_cast<double>(shadows_.pixels[i][c]) / (open * kLightSteps), 0.0));
    return left;
}

/// Returns the coverage of a ground shadow at pixel `i`: 1 minus the displayed value of white in this shadow.
float LightSum::groundCoverage(std::size_t i) const {
    return 1 - displayFromLinear(leftOfBackground(i)[0]);
}

Picture LightSum::picture(const ToneMapping& shown) const {
    GNOMON_CHECK(count_ > 0);
    const auto lastRow = static_cast<std::size_t>(firstRow_) + static_cast<std::size_t>(sums_.height);
    GNOMON_CHECK(shown.backgroundRows.size() >= lastRow);
    // Number of image rows above the rows in the sum.
    const std::size_t above = shown.backgroundRows.size() - lastRow;
    block::Frame curve{};
    curve.isToneMapped = shown.isToneMapped ? 1 : 0;
    const LightPicture mean = this->mean();
    Picture picture(sums_.width, sums_.height);
    forAllPixels(picture.pixels.size(), [&](std::size_t i) {
        const Rgb& behind = shown.backgroundRows[above + i / static_cast<std::size_t>(sums_.width)];
        const int covered = covered_.pixels[i];
        const std::array<float, 3> left = leftOfBackground(i);
        const auto background = [&](std::size_t c) {
            return left[c] * linearFromDisplay(static_cast<float>(behind[c]) / 255);
        };
        if (covered == 0) {
            picture.pixels[i] = shown.isTransparent ? Rgb{} : behind;
            if (hasGround_ && !shown.isTransparent)
                for (std::size_t c = 0; c < 3; ++c)
                    picture.pixels[i][c] = screenLevel(background(c));
            return;
        }
        const int frames = framesOf(i);
        const bool isMixed = covered < frames && !shown.isTransparent;
        const float share = static_cast<float>(covered) / static_cast<float>(frames);
        const float ofSurface =
            hasGround_ && shown.isTransparent ? share / (share + (1 - share) * groundCoverage(i)) : 1;
        for (std::size_t c = 0; c < 3; ++c) {
            float linear = toneMapped(curve, mean.pixels[i][c]);
            if (isMixed) linear = share * linear + (1 - share) * background(c);
            picture.pixels[i][c] = screenLevel(ofSurface * linear);
        }
    });
    return picture;
}

Coverage LightSum::coverage() const {
    Coverage coverage(covered_.width, covered_.height);
    forAllPixels(coverage.pixels.size(), [&](std::size_t i) {
        const auto count = static_cast<std::uint32_t>(framesOf(i));
        coverage.pixels[i] = static_cast<std::uint8_t>((255 * std::uint32_t{covered_.pixels[i]} + count / 2) / count);
        if (!hasGround_) return;
        const float open = static_cast<float>(count - covered_.pixels[i]) * groundCoverage(i);
        const float covered = (static_cast<float>(covered_.pixels[i]) + open) / static_cast<float>(count);
        coverage.pixels[i] = static_cast<std::uint8_t>(std::lround(255 * covered));
    });
    return coverage;
}

} // namespace gnomon::render
