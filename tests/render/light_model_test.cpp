// Light: the curves against their definitions, and what each shading shows of surfaces that lie differently.
#include "render/light/background.h"
#include "render/light/eye_dome.h"
#include "render/light/light_model.h"
#include "render/light/light_sum.h"
#include "tests/support/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::render {
namespace {

double srgbOf(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

TEST(Transfer, IsThatOfSrgbWithinAThirdOfALevel) {
    for (int i = 0; i <= 100000; ++i) {
        const double linear = std::pow(i / 100000.0, 2.2);
        EXPECT_NEAR(displayFromLinear(static_cast<float>(linear)), srgbOf(linear), 1.0 / (3 * 255));
    }
    for (int i = 0; i <= 255; ++i) {
        const double display = i / 255.0;
        const float linear = linearFromDisplay(static_cast<float>(display));
        EXPECT_NEAR(srgbOf(linear), display, 1.0 / (3 * 255)) << i;
        EXPECT_EQ(std::lround(displayFromLinear(linear) * 255), i);
    }
}

TEST(Transfer, NeverFalls) {
    for (int i = 1; i <= 65535; ++i) {
        const auto value = [](int k) { return static_cast<float>(k) / 65535; };
        EXPECT_LE(displayFromLinear(value(i - 1)), displayFromLinear(value(i)));
        EXPECT_LE(linearFromDisplay(value(i - 1)), linearFromDisplay(value(i)));
    }
}

TEST(EyeDome, DarkensWhatLiesBehindItsSurroundingsAndNoPlane) {
    const Picture grey(40, 30, {150, 120, 90});
    const auto shown = [&](const auto& depthAt) {
        FloatPicture depth(grey.width, grey.height);
        for (int y = 0; y < depth.height; ++y)
            for (int x = 0; x < depth.width; ++x)
                depth.at(x, y) = static_cast<float>(depthAt(x, y));
        Picture picture = grey;
        applyEyeDome(picture, depth);
        return picture;
    };
    const auto inside = [&](const Picture& picture, const auto& expect) {
        for (int y = 2; y + 2 < picture.height; ++y)
            for (int x = 2; x + 2 < picture.width; ++x)
                expect(x, y, picture.at(x, y));
    };
    // A floor that runs to the horizon: 1/depth falls evenly.
    inside(shown([](int /*x*/, int y) { return 1 / (0.001 + 0.01 * y); }), [&](int x, int y, const Rgb& pixel) {
        EXPECT_EQ(pixel, (Rgb{150, 120, 90})) << x << " " << y;
    });
    // A corner of two walls is dark where they meet, a ridge is not.
    inside(
        shown([](int x, int /*y*/) { return 1 / (0.1 + 0.01 * std::abs(x - 20)); }),
        [&](int x, int y, const Rgb& pixel) { EXPECT_EQ(pixel[0] < 150, std::abs(x - 20) < 2) << x << " " << y; });
    inside(
        shown([](int x, int /*y*/) { return 1 / (0.5 - 0.01 * std::abs(x - 20)); }),
        [&](int x, int y, const Rgb& pixel) { EXPECT_EQ(pixel[0], 150) << x << " " << y; });
    // What stands before another thing outlines it; nothing is drawn where nothing is.
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    inside(
        shown([](int x, int /*y*/) { return x < 10   ? 1
                                            : x < 20 ? 5
                                                     : kNothing; }),
        [&](int x, int y, const Rgb& pixel) {
            const bool isBehind = x == 10 || x == 11;
            EXPECT_EQ(pixel[0] < 150, isBehind) << x << " " << y;
        });
}

constexpr std::array<float, 3> kNoSurface = {-1, -1, -1};

/// Light by which a surface is shown as `color`, without a shoulder.
std::array<float, 3> lightShownAs(const Rgb& color) {
    std::array<float, 3> light{};
    for (std::size_t c = 0; c < color.size(); ++c)
        light[c] = linearFromDisplay(static_cast<float>(color[c]) / 255);
    return light;
}

TEST(LightSum, OfEqualFramesIsWhatEachOfThemShows) {
    LightPicture all(256, 1);
    Picture wanted(256, 1);
    for (std::size_t i = 0; i < all.pixels.size(); ++i) {
        wanted.pixels[i] = {
            static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(i * 7 % 256)};
        all.pixels[i] = lightShownAs(wanted.pixels[i]);
    }
    const ToneMapping unlit{false, false, {Rgb{1, 2, 3}}};
    LightSum sum;
    for (int count = 1; count <= LightSum::kMaxPictures; ++count) {
        sum.add(all);
        if (count < 70 || count == LightSum::kMaxPictures) {
            ASSERT_TRUE(sum.picture(unlit).pixels == wanted.pixels) << count;
        }
    }
    sum.reset();
    sum.add(LightPicture(3, 2, kNoSurface));
    EXPECT_EQ(sum.count(), 1);
    const Picture behind = sum.picture({true, false, {Rgb{9, 8, 7}, Rgb{6, 5, 4}}});
    EXPECT_EQ(behind.at(2, 0), (Rgb{9, 8, 7})) << "of another size, and nothing is left";
    EXPECT_EQ(behind.at(0, 1), (Rgb{6, 5, 4}));
}

TEST(LightSum, HoldsTheBrightestLightAsOftenAsThereCanBeFrames) {
    LightSum sum;
    const LightPicture brightest(1, 1, {4096, 1e30F, 4095.5F});
    for (int count = 1; count <= LightSum::kMaxPictures; ++count)
        sum.add(brightest);
    EXPECT_EQ(sum.picture({true, false, {Rgb{}}}).pixels[0], (Rgb{255, 255, 255}));
}

// What makes the mean one of light, not of what is shown of it: the sun on half of a surface in the shade.
TEST(LightSum, TakesTheMeanBeforeTheShoulder) {
    LightSum sum;
    sum.add(LightPicture(1, 1, {3, 0.25F, 3}));
    sum.add(LightPicture(1, 1, {0, 0.25F, 1}));
    const Picture mean = sum.picture({true, false, {Rgb{}}});
    const auto level = [](double light) { return 255 * srgbOf(light / (1 + light)); };
    EXPECT_NEAR(mean.pixels[0][0], level(1.5), 0.9) << "not " << level(3) << " and black, mixed";
    EXPECT_NEAR(mean.pixels[0][1], level(0.25), 0.9);
    EXPECT_NEAR(mean.pixels[0][2], level(2), 0.9);
}

// A shadow on the ground in one frame of two, and a surface before it in a third.
TEST(LightSum, LeavesOfTheBackgroundWhatShadowsOnItDo) {
    LightSum sum;
    sum.reset(true);
    sum.add(LightPicture(1, 1, {-1 + 0.75F * kGroundShade, -1 + 0.5F * kGroundShade, -1}));
    sum.add(LightPicture(1, 1, kNoSurface));
    const ToneMapping shown{true, false, {Rgb{255, 255, 255}}, true};
    const Picture half = sum.picture(shown);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(half.pixels[0][c], 255 * srgbOf(std::array{0.625, 0.75, 1.0}[c]), 0.9) << c;
    EXPECT_NEAR(sum.coverage().pixels[0], 255 * (1 - srgbOf(0.625)), 0.9);
    sum.add(LightPicture(1, 1, {1, 1, 1}));
    const Picture edge = sum.picture(shown);
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(edge.pixels[0][c], 255 * srgbOf((0.5 + 2 * std::array{0.625, 0.75, 1.0}[c]) / 3), 0.9) << c;
    sum.reset();
    sum.add(LightPicture(1, 1, kNoSurface));
    EXPECT_EQ(sum.picture({true, false, {Rgb{9, 8, 7}}}).pixels[0], (Rgb{9, 8, 7})) << "no ground, and none is left";
}

// An edge before a background that is as bright as a screen can be: half of either, as the screen's light goes.
TEST(LightSum, MixesTheBackgroundByWhatItCovers) {
    LightSum sum;
    sum.add(LightPicture(1, 1, {0, 1, 3}));
    sum.add(LightPicture(1, 1, kNoSurface));
    sum.add(LightPicture(1, 1, kNoSurface));
    const Rgb white = {255, 255, 255};
    const Picture edge = sum.picture({true, false, {white}});
    for (std::size_t c = 0; c < 3; ++c) {
        const double surface = std::array{0.0, 0.5, 0.75}[c];
        EXPECT_NEAR(edge.pixels[0][c], 255 * srgbOf((surface + 2) / 3), 0.9) << c;
    }
    EXPECT_EQ(sum.coverage().pixels[0], 85);
    const Picture alone = sum.picture({true, true, {Rgb{}}});
    EXPECT_NEAR(alone.pixels[0][2], 255 * srgbOf(0.75), 0.9) << "what covers nothing has no colour";
}

block::Frame lightOf(plan::Shading shading, double ambient = 1) {
    block::Frame block{};
    plan::View view;
    view.camera.eye = {0, 1, 5};
    setLight(view, {shading, ambient, {}}, shading, block);
    return block;
}

/// What is shown of a white surface of normal `n` seen along -`v`, in the sun or not.
glm::vec3 shown(const block::Frame& block, const glm::vec3& n, const glm::vec3& v, bool isInSun) {
    const plan::View view;
    const float cosine = glm::dot(n, glm::normalize(glm::vec3(view.towardsLight)));
    const float facing = glm::dot(n, v);
    const glm::vec3 light = block.ambientMean + block.ambientTilt * glm::dot(n, block.skyAxis) +
                            block.headlight * facing * facing + block.sun * (isInSun ? std::max(cosine, 0.0F) : 0.0F);
    glm::vec3 color(0);
    for (int c = 0; c < 3; ++c)
        color[c] = displayFromLinear(toneMapped(block, light[c]));
    return color;
}

/// Directions all round.
std::vector<glm::vec3> directions() {
    std::vector<glm::vec3> all;
    for (int i = 0; i < 400; ++i) {
        const double y = 1 - (i + 0.5) / 200;
        const double turn = 2.399963 * i;
        const double r = std::sqrt(1 - y * y);
        all.emplace_back(r * std::cos(turn), y, r * std::sin(turn));
    }
    return all;
}

TEST(Light, MakesNoWhiteSurfaceBlackOrBurntOut) {
    for (const plan::Shading shading : {plan::Shading::Lit, plan::Shading::Headlight, plan::Shading::Flat})
        for (const glm::vec3& n : directions())
            for (const bool isInSun : {false, true})
                for (const glm::vec3& v : {n, glm::normalize(n + glm::vec3(0.3, 1, 0.2)), glm::vec3(0, 0, 1)}) {
                    const glm::vec3 color = shown(lightOf(shading), n, v, isInSun);
                    for (int c = 0; c < 3; ++c) {
                        EXPECT_GT(color[c], 0.2F);
                        EXPECT_LT(color[c], 0.95F);
                    }
                }
}

TEST(Light, ShowsWallsFloorAndCeilingApartInTheShadow) {
    const glm::vec3 v(0, 0, 1); // along a corridor
    for (const plan::Shading shading : {plan::Shading::Lit, plan::Shading::Headlight}) {
        const block::Frame block = lightOf(shading);
        std::vector<float> found;
        for (const glm::vec3& n : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), v})
            found.push_back(shown(block, n, v, false).g);
        std::sort(found.begin(), found.end());
        for (std::size_t i = 1; i < found.size(); ++i)
            EXPECT_GT(found[i] - found[i - 1], 0.015F) << i;
    }
}

TEST(Light, UnlitSurfacesAreShownAsTheyAre) {
    const block::Frame block = lightOf(plan::Shading::Unlit, 3);
    for (const glm::vec3& n : directions())
        EXPECT_EQ(shown(block, n, glm::vec3(0, 0, 1), true), glm::vec3(displayFromLinear(1)));
    for (int i = 0; i <= 255; ++i)
        EXPECT_EQ(
            std::lround(255 * displayFromLinear(toneMapped(block, linearFromDisplay(static_cast<float>(i) / 255)))), i);
}

TEST(Light, AmbientIsAMultiple) {
    for (const plan::Shading shading : {plan::Shading::Lit, plan::Shading::Headlight}) {
        EXPECT_EQ(lightOf(shading, 2).ambientMean, 2.0F * lightOf(shading).ambientMean);
        EXPECT_EQ(lightOf(shading, 0).ambientTilt, glm::vec3(0));
        EXPECT_EQ(lightOf(shading, 2).sun, lightOf(shading).sun);
    }
}

TEST(Background, IsTheSkyOfEachRowOrOneColour) {
    const Field field;
    plan::Quality quality;
    const auto rowsOf = [&] {
        const plan::FramePlan plan = field.plan(field.view(3), quality);
        return backgroundRows(field.drawing(plan));
    };
    const std::vector<Rgb> sky = rowsOf();
    ASSERT_EQ(sky.size(), static_cast<std::size_t>(kFieldSide));
    EXPECT_NE(sky.front(), sky.back());
    EXPECT_LT(skyColor(1)[0], skyColor(0)[0]) << "the zenith is darker than the horizon";
    EXPECT_EQ(skyColor(-0.5), skyColor(-1));
    quality.look.background = {plan::Background::Kind::Color, {1, 2, 3}};
    EXPECT_EQ(rowsOf(), std::vector<Rgb>(kFieldSide, Rgb{1, 2, 3}));
    quality.look.background = {plan::Background::Kind::Transparent, {}};
    EXPECT_EQ(rowsOf(), std::vector<Rgb>(kFieldSide, Rgb{}));
}

} // namespace
} // namespace gnomon::render
