// Pictures of several frames against the plain mean, in doubles, of frames that are rendered one by one.
#include "core/random.h"
#include "frame/accumulation.h"
#include "render/gl/gl_backend.h"
#include "render/light/background.h"
#include "render/software_backend.h"
#include "tests/support/drawn_model.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace gnomon::frame {
namespace {

using plan::ShadowMode;

/// Hills, opened once.
const hierarchy::ModelFile& hills() {
    static DrawnModel model([] {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 10;
        options.colors = true;
        return tests::makeTinyModel(options);
    }());
    return model.file();
}

plan::View randomView(Random& random, int width, int height) {
    const Box& bounds = hills().summary().bounds;
    plan::View view;
    view.width = width;
    view.height = height;
    const double x = random.uniform(-0.2, 1.2);
    const double y = random.uniform(1.2, 2);
    const double z = random.uniform(-0.2, 1.2);
    view.camera.eye = bounds.min + bounds.extent() * glm::dvec3(x, y, z);
    view.camera.target = bounds.center();
    view.towardsLight = {random.uniform(-1, 1), 0.5, random.uniform(-1, 1)};
    return view;
}

double linearOf(double display) {
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

double levelOf(double linear) {
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
}

/// The same by a renderer that knows no accumulation: each frame planned and drawn by itself, in doubles.
class PlainMean {
public:
    explicit PlainMean(render::Backend& backend) : backend_(&backend), renderer_(hills(), backend, {}) {}

    void draw(const plan::View& view, const plan::Quality& quality, int samples) {
        const std::size_t pixels = static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height);
        sums_.assign(3 * pixels, 0);
        covered_.assign(pixels, 0);
        samples_ = samples;
        isTransparent_ = quality.look.background.kind == plan::Background::Kind::Transparent;
        for (int sample = 0; sample < samples; ++sample) {
            FrameOptions options;
            options.isAccumulated = true;
            options.subpixel = subpixelOffset(sample);
            options.mapShift = mapShift(sample);
            const Frame frame = renderer_.render(view, quality, options);
            background_ = render::backgroundRows(renderer_.drawing(frame, options));
            add(backend_->light());
        }
    }

    /// Of the mean in the frames that cover the pixel, beyond the shoulder; mixed with the background by their share.
    double level(std::size_t pixel, std::size_t channel) const {
        const double covered = covered_[pixel];
        const double light = covered == 0 ? 0 : sums_[3 * pixel + channel] / covered;
        const double share = isTransparent_ ? 1 : covered / samples_;
        const std::size_t row = pixel / (covered_.size() / background_.size());
        return levelOf(share * light / (1 + light) + (1 - share) * linearOf(background_[row][channel] / 255.0));
    }

    int covered(std::size_t pixel) const { return covered_[pixel]; }

private:
    render::Backend* backend_;
    Renderer renderer_;

    void add(const render::LightPicture& light) {
        const render::FloatPicture depth = backend_->viewDepth();
        const render::Picture picture = backend_->picture();
        std::size_t apart = 0;
        for (std::size_t i = 0; i < light.pixels.size(); ++i) {
            ASSERT_EQ(light.pixels[i][0] >= 0, std::isfinite(depth.pixels[i]));
            if (light.pixels[i][0] < 0) continue;
            ++covered_[i];
            for (std::size_t c = 0; c < 3; ++c) {
                const double reflected = light.pixels[i][c];
                sums_[3 * i + c] += reflected;
                apart += std::abs(levelOf(reflected / (1 + reflected)) - picture.pixels[i][c]) > 0.9 ? 1 : 0;
            }
        }
        EXPECT_EQ(apart, 0U) << "the picture shows another light";
    }

    bool isTransparent_ = false;
    int samples_ = 1;
    std::vector<render::Rgb> background_;
    std::vector<double> sums_;
    std::vector<int> covered_;
};

class AccumulationTwins : public testing::TestWithParam<std::unique_ptr<render::Backend> (*)()> {
protected:
    /// Both means of `samples` frames of a view; the largest difference that a rounding explains is one level.
    void expectAlike(const plan::View& view, const plan::Quality& quality, int samples) {
        const bool isTransparent = quality.look.background.kind == plan::Background::Kind::Transparent;
        FrameOptions options;
        options.isAccumulated = true;
        const Frame frame = renderer_.render(view, quality, options);
        Accumulation accumulation;
        accumulation.begin(renderer_, frame, samples);
        while (accumulation.samples() < samples)
            accumulation.add();
        PlainMean plain(*other_);
        plain.draw(view, quality, samples);
        const render::Picture picture = accumulation.picture();
        const auto coverage = accumulation.coverage();
        ASSERT_EQ(coverage.has_value(), isTransparent);
        std::size_t apart = 0;
        std::size_t mixed = 0;
        for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
            if (coverage) {
                const double share = static_cast<double>(plain.covered(i)) / samples;
                ASSERT_NEAR(coverage->pixels[i], 255 * share, 0.51) << i;
                mixed += share > 0 && share < 1 ? 1 : 0;
            }
            for (std::size_t c = 0; c < 3; ++c)
                apart += std::abs(picture.pixels[i][c] - plain.level(i, c)) > 0.9 ? 1 : 0;
        }
        EXPECT_EQ(apart, 0U) << "of " << picture.pixels.size() << " pixels, " << samples << " samples";
        edges += mixed;
    }

    std::size_t edges = 0; // pixels that were partly covered

private:
    std::unique_ptr<render::Backend> backend_ = GetParam()();
    std::unique_ptr<render::Backend> other_ = GetParam()();
    Renderer renderer_{hills(), *backend_, {}};
};

plan::Quality randomQuality(Random& random, bool isSoftware) {
    plan::Quality quality;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    quality.errorPixels = random.uniform(0.3, 3);
    quality.look.shading = plan::Shading::Lit;
    constexpr std::array kModes = {ShadowMode::Maps, ShadowMode::Off, ShadowMode::Rays, ShadowMode::Exact};
    quality.shadows = kModes[random.below(isSoftware ? 4 : 3)];
    quality.filter = random.below(2) == 0 ? 1 : 3;
    if (random.below(3) == 0) quality.look.background = {plan::Background::Kind::Transparent, {}};
    return quality;
}

TEST_P(AccumulationTwins, AreTheMeanOfFramesRenderedOneByOne) {
    Random random(20);
    const bool isSoftware = GetParam() == &render::makeSoftwareBackend;
    for (int round = 0; round < (isSoftware ? 24 : 6); ++round) {
        const plan::View view = randomView(random, 96, 64);
        const plan::Quality quality = randomQuality(random, isSoftware);
        SCOPED_TRACE(
            "round " + std::to_string(round) + ", shadows " + std::to_string(static_cast<int>(quality.shadows)));
        expectAlike(view, quality, static_cast<int>(1 + random.below(9)));
    }
    EXPECT_GT(edges, 50U) << "this tests nothing";
}

TEST_P(AccumulationTwins, DrawWholeMapsMovedBySample) {
    const auto backend = GetParam()();
    Renderer renderer(hills(), *backend, {});
    Random random(3);
    const plan::View view = randomView(random, 96, 64);
    plan::Quality quality;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 256;
    FrameOptions options;
    const History history = renderer.render(view, quality, options).history;
    options.isAccumulated = true;
    const Frame frame = renderer.render(view, quality, options, history);
    const render::FloatPicture maps = backend->shadowDepth();
    ASSERT_GT(maps.width, 0);
    Accumulation accumulation;
    accumulation.begin(renderer, frame, 5);
    const auto fresh = GetParam()();
    Renderer whole(hills(), *fresh, {});
    options.wantsWholeMaps = true;
    const History before = whole.render(view, quality, {}).history;
    for (int sample = 0; sample < 5; ++sample) {
        if (sample > 0) accumulation.add();
        options.mapShift = mapShift(sample);
        whole.render(view, quality, options, before);
        EXPECT_EQ(backend->shadowDepth().pixels, fresh->shadowDepth().pixels) << sample;
        EXPECT_EQ(backend->shadowDepth().pixels == maps.pixels, sample == 0);
    }
}

std::unique_ptr<render::Backend> osmesa() {
    return render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(std::nullopt), mebibytes(64));
}

INSTANTIATE_TEST_SUITE_P(Software, AccumulationTwins, testing::Values(&render::makeSoftwareBackend));
INSTANTIATE_TEST_SUITE_P(Osmesa, AccumulationTwins, testing::Values(&osmesa));

// A picture of twice the size has its pixels where four offsets have theirs.
TEST(SubpixelOffsets, AreThePixelsOfALargerPicture) {
    Random random(7);
    const auto backend = render::makeSoftwareBackend();
    Renderer renderer(hills(), *backend, {});
    plan::Quality quality;
    quality.shadows = ShadowMode::Off;
    quality.errorPixels = 1e-9;
    quality.look.background = {plan::Background::Kind::Color, {90, 90, 90}};
    plan::View view = randomView(random, 160, 100);
    renderer.render(view, quality, {});
    const render::Picture large = backend->picture();
    view.width /= 2;
    view.height /= 2;
    std::size_t apart = 0;
    for (const int x : {0, 1})
        for (const int y : {0, 1}) {
            FrameOptions options;
            options.subpixel = {x * 0.5 - 0.25, 0.25 - y * 0.5}; // right and up
            renderer.render(view, quality, options);
            const render::Picture small = backend->picture();
            for (int row = 0; row < view.height; ++row)
                for (int column = 0; column < view.width; ++column)
                    apart += small.at(column, row) != large.at(2 * column + x, 2 * row + y) ? 1 : 0;
        }
    EXPECT_LT(apart, large.pixels.size() / 100);
}

TEST(SubpixelOffsets, BeginInTheMiddleAndFillEachElementaryIntervalOnce) {
    EXPECT_EQ(subpixelOffset(0), glm::dvec2(0));
    for (int exponent = 0; exponent <= 10; ++exponent)
        for (int across = 0; across <= exponent; ++across) {
            const int columns = 1 << across;
            const int rows = 1 << (exponent - across);
            std::vector<int> held(std::size_t{1} << exponent);
            for (int sample = 0; sample < 1 << exponent; ++sample) {
                const glm::dvec2 at = subpixelOffset(sample);
                ASSERT_TRUE(at.x >= -0.5 && at.x < 0.5 && at.y >= -0.5 && at.y < 0.5) << sample;
                const int column = static_cast<int>((at.x + 0.5) * columns);
                const int row = static_cast<int>((at.y + 0.5) * rows);
                ++held
                    [static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
            }
            for (const int count : held)
                ASSERT_EQ(count, 1) << columns << " x " << rows;
        }
}

} // namespace
} // namespace gnomon::frame
