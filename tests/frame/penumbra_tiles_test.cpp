// Frames of the light's disc that are drawn in the tiles of its penumbrae alone, against frames drawn whole.
#include "frame/accumulation.h"
#include "plan/light_directions.h"
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "tests/support/sanitizers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::frame {
namespace {

/// A plain that is cut into small clusters, with a high crate at one side of the view.
tests::SceneMesh crateBesideEmptyGround() {
    tests::SceneMesh scene;
    scene.addGround(64, 128);
    scene.addBox({-6, 0, -2}, {-4, 5, 0});
    return scene;
}

plan::View overEmptyGround() {
    plan::View view = overGround();
    view.width = 116; // the last tiles are cut off
    view.height = 112;
    view.towardsLight = {-0.2, 1, -0.1};
    view.sunAngleRadians = 0.02;
    return view;
}

plan::Quality softQuality(plan::ShadowMode shadows, double error) {
    plan::Quality quality;
    quality.shadows = shadows;
    quality.look.shading = plan::Shading::Lit;
    quality.look.ambient = 0;
    quality.lightError = error;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512;
    return quality;
}

/// What some frames of a picture come to.
struct Mean {
    render::LightPicture light;
    render::Picture picture;
    render::Coverage coverage;
    std::shared_ptr<const shadow::TileMask> tiles;
    int frames = 0;
};

enum class Tiles : std::uint8_t { AsPlanned, All };

/// After `drawn` frames, or all.
Mean meanOf(
    DrawnModel& model,
    const plan::View& view,
    const plan::Quality& quality,
    Tiles tiles,
    int samples,
    std::optional<int> drawn = std::nullopt) {
    FrameOptions options;
    options.isAccumulated = true;
    Frame frame = model.draw(view, quality, options);
    const auto planned = frame.plan.penumbra.tiles;
    if (tiles == Tiles::All) frame.plan.penumbra.tiles.reset();
    Accumulation accumulation;
    accumulation.begin(model.renderer(), frame, samples);
    while (accumulation.samples() < drawn.value_or(accumulation.wanted()))
        accumulation.add();
    return {
        accumulation.light(),
        accumulation.picture(),
        accumulation.coverage().value_or(render::Coverage()),
        planned,
        accumulation.wanted()};
}

bool isSoft(const Mean& mean, int x, int y) {
    return mean.tiles->holds(x, mean.picture.height - 1 - y);
}

/// In how many pixels `found` is neither `soft` in its tiles nor `hard` elsewhere.
std::size_t pixelsApart(const Mean& found, const Mean& soft, const Mean& hard) {
    std::size_t apart = 0;
    for (int y = 0; y < found.picture.height; ++y)
        for (int x = 0; x < found.picture.width; ++x) {
            const Mean& wanted = isSoft(found, x, y) ? soft : hard;
            const bool isSame = found.light.at(x, y) == wanted.light.at(x, y) &&
                                found.picture.at(x, y) == wanted.picture.at(x, y) &&
                                found.coverage.at(x, y) == wanted.coverage.at(x, y);
            if (!isSame) ++apart;
        }
    return apart;
}

// The tiles that are drawn get what they would get anyway, the others what they had after the first frames.
TEST(PenumbraTiles, AreThoseOfWholeFramesAndTheOthersThoseOfTheFirstFrames) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const tests::SceneMesh scene = crateBesideEmptyGround();
    constexpr int kSamples = 5;
    for (const plan::ShadowMode shadows : {plan::ShadowMode::Exact, plan::ShadowMode::Rays, plan::ShadowMode::Maps}) {
        DrawnModel model(scene.model());
        const plan::View view = overEmptyGround();
        plan::Quality quality = softQuality(shadows, 0.1);
        quality.occlusion = shadows == plan::ShadowMode::Exact ? plan::Choice::On : plan::Choice::Off;
        quality.look.background = {plan::Background::Kind::Transparent, {}};
        const Mean found = meanOf(model, view, quality, Tiles::AsPlanned, kSamples);
        ASSERT_TRUE(found.tiles);
        ASSERT_EQ(found.frames, 32);
        EXPECT_GT(found.tiles->count(), 1U);
        EXPECT_LT(found.tiles->count(), found.tiles->wanted.size() / 2) << "this tests nothing";
        const Mean whole = meanOf(model, view, quality, Tiles::All, kSamples);
        const Mean first = meanOf(model, view, quality, Tiles::All, kSamples, plan::minFirstPoints(32));
        EXPECT_EQ(pixelsApart(found, whole, first), 0U) << static_cast<int>(shadows);
        EXPECT_NE(whole.light.pixels, first.light.pixels);
    }
}

TEST(PenumbraTiles, LeaveNothingOutWhereThereAreAsManyFramesAsDirections) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    DrawnModel model(crateBesideEmptyGround().model());
    const plan::Quality quality = softQuality(plan::ShadowMode::Exact, 0.1);
    const plan::View view = overEmptyGround();
    EXPECT_EQ(
        meanOf(model, view, quality, Tiles::AsPlanned, 32).picture.pixels,
        meanOf(model, view, quality, Tiles::All, 32).picture.pixels);
}

// A tile that is left out after 64 frames is as near to all 160 as the places of so many frames let any be, which are
// off by 0.13 and by 0.08 beside an edge, of which two meet at a corner: its penumbrae are narrower than half a pixel.
TEST(PenumbraTiles, LeftOutAreWithinTheErrorOfAllDirections) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    tests::SceneMesh scene = crateBesideEmptyGround();
    for (int i = 0; i < 5; ++i)
        scene.addBox({i - 1, 0, -1 + i}, {i - 0.2, 0.3, -0.2 + i});
    DrawnModel model(scene.model());
    const plan::View view = overEmptyGround();
    plan::Quality quality = softQuality(plan::ShadowMode::Exact, 0.04);
    const Mean found = meanOf(model, view, quality, Tiles::AsPlanned, 64);
    ASSERT_TRUE(found.tiles);
    ASSERT_EQ(found.frames, 160);
    const Mean whole = meanOf(model, view, quality, Tiles::All, 64);
    quality.shadows = plan::ShadowMode::Off;
    const Mean open = meanOf(model, view, quality, Tiles::All, 64);
    double worst = 0;
    double mean = 0;
    int shaded = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double light = open.light.at(x, y)[1];
            const double share = whole.light.at(x, y)[1] / light;
            if (isSoft(found, x, y) || !(light > 0.1) || !(share > 0.02 && share < 0.98)) continue;
            const double off = std::abs(found.light.at(x, y)[1] / light - share);
            worst = std::max(worst, off);
            mean += off;
            ++shaded;
        }
    EXPECT_GT(shaded, 40);
    EXPECT_LE(worst, 2 * (0.13 + 0.08));
    EXPECT_LE(mean / shaded, 0.04);
}

} // namespace
} // namespace gnomon::frame
