// The steps of the keys, the graph's medians, the messages and the words.
#include "plan/plan_frame.h"
#include "settings/plan_sentences.h"
#include "viewer/messages.h"
#include "viewer/panel/frame_history.h"
#include "viewer/panel/plan_words.h"
#include "viewer/view_settings.h"

#include <gtest/gtest.h>

namespace gnomon::viewer {
namespace {

TEST(ViewSettings, SchemesStepAroundAndAreWhatTheyAreCalled) {
    plan::Quality quality;
    EXPECT_EQ(schemeOf(quality), Scheme::Slices);
    for (std::size_t i = 0; i < kSchemes.size(); ++i) {
        const Scheme before = schemeOf(quality);
        stepScheme(quality, 1);
        EXPECT_NE(schemeOf(quality), before);
    }
    EXPECT_EQ(schemeOf(quality), Scheme::Slices);
    for (const Scheme from : kSchemes)
        for (const Scheme to : kSchemes) {
            choose(from, quality);
            choose(to, quality);
            EXPECT_EQ(schemeOf(quality), to) << name(from) << " to " << name(to);
        }
    choose(Scheme::Off, quality);
    EXPECT_EQ(quality.shadows, plan::ShadowMode::Off);
    choose(Scheme::Rays, quality);
    EXPECT_EQ(quality.shadows, plan::ShadowMode::Rays);
    choose(Scheme::Auto, quality);
    EXPECT_EQ(quality.shadows, plan::ShadowMode::Auto);
    quality.mapsBecause = plan::ShadowReason::MapsRequested; // as a change of slices does
    EXPECT_NE(schemeOf(quality), Scheme::Auto);
    choose(Scheme::Auto, quality);
    EXPECT_EQ(schemeOf(quality), Scheme::Auto);
}

TEST(FrameHistory, KeepsTheLastAndTakesTheirMedians) {
    FrameHistory history(10);
    for (int i = 0; i < 25; ++i) {
        StageTimes times{};
        times[0] = i;
        history.add(times);
    }
    EXPECT_EQ(history.frames().size(), 10U);
    EXPECT_EQ(history.medians(3)[0], 23);
    EXPECT_EQ(history.medians(100)[0], 19.5);
    EXPECT_EQ(FrameHistory(4).medians(30)[0], 0);
}

TEST(Messages, AreShownForAWhileAndFailuresOnce) {
    double now = 0;
    std::vector<std::string> told;
    Messages messages([&] { return now; }, [&](const std::string& text) { told.push_back(text); });
    messages.show("warp: none");
    now = 0.5;
    messages.show("warp: auto");
    ASSERT_EQ(messages.all().size(), 1U);
    EXPECT_EQ(messages.all()[0].text, "warp: auto");
    now = 1;
    messages.fail("broken");
    now = 2;
    EXPECT_FALSE(messages.attempt([] { throw std::runtime_error("broken"); }));
    EXPECT_TRUE(messages.attempt([] {}));
    EXPECT_EQ(told, std::vector<std::string>{"broken"});
    EXPECT_EQ(messages.all().size(), 2U);
    messages.show("next");
    EXPECT_EQ(messages.all().size(), 3U); // a failure is not replaced
    now = 10;
    EXPECT_TRUE(messages.expire());
    EXPECT_EQ(messages.all().size(), 1U);
    now = 30;
    EXPECT_TRUE(messages.expire());
    now = 31;
    EXPECT_FALSE(messages.expire());
}

TEST(PlanWords, SayWhatIsPlannedAndWhatIsLeftOut) {
    plan::View view;
    view.camera = {{0, 2, 30}, {0, 0, 0}, {0, 1, 0}, 1};
    plan::SceneFacts facts;
    facts.bounds = {{-10, -2, -10}, {10, 2, 10}};
    facts.visible = {18, 44, true};
    const plan::FramePlan plan = plan::planFrame(view, {}, facts).plan;
    telemetry::FrameRow row;
    row.aliasingBoundX = 1.25;
    row.aliasingBoundZ = 2.5;
    row.storageFactor = 3;
    std::string all;
    for (const std::string& line : planInWords(plan, row))
        all += line + "\n";
    EXPECT_NE(all.find("4 maps, 4 slices, warp auto"), std::string::npos) << all;
    EXPECT_NE(all.find("aliasing bound 1.25 across, 2.5 along"), std::string::npos) << all;
    EXPECT_NE(all.find("measured aliasing: not yet"), std::string::npos) << all;
    for (const plan::SkippedEffect& skipped : plan.omitted)
        EXPECT_NE(all.find(settings::reasonInWords(skipped)), std::string::npos) << all;
    row.measuredAliasing = 2.25;
    EXPECT_NE(testing::PrintToString(planInWords(plan, row)).find("measured aliasing 2.25"), std::string::npos);

    row.imageTriangles = 1200;
    EXPECT_EQ(
        statusInWords(plan, row, {17.6, 0, 64, ""}),
        "18 ms \xC2\xB7 1.2k triangles \xC2\xB7 4 maps, aliasing bound 2.5");
    row.pagesMissing = 3;
    row.pagesDamaged = 1;
    EXPECT_EQ(
        statusInWords(plan, row, {5, 7, 64, "slices 4 -> 3"}),
        "5 ms \xC2\xB7 1.2k triangles \xC2\xB7 4 maps, aliasing bound 2.5 \xC2\xB7 given up: slices 4 -> 3 \xC2\xB7 "
        "loading "
        "3 "
        "pages \xC2\xB7 1 pages DAMAGED \xC2\xB7 sample 7 of 64");
    EXPECT_EQ(statusInWords(plan, row, {5, 64, 64, ""}).find("sample"), std::string::npos) << "it is done";
}

TEST(ColorChoices, AreWhatTheModelAndTheBackendHave) {
    using settings::ColorBy;
    hierarchy::ModelSummary model;
    EXPECT_EQ(colorChoices(model, plan::kOpenGlCapabilities).size(), 3U);   // none, height, slope
    EXPECT_EQ(colorChoices(model, plan::kSoftwareCapabilities).size(), 4U); // and the error
    model.hasColors = true;
    model.fields = {{"rain", 0, 1}, {"wind", 0, 1}};
    EXPECT_EQ(colorChoices(model, plan::kOpenGlCapabilities).size(), 3U);
    const std::vector<settings::ValueColors> all = colorChoices(model, plan::kSoftwareCapabilities);
    ASSERT_EQ(all.size(), 7U);
    EXPECT_EQ(all[0].by, ColorBy::None);
    settings::ValueColors colors;
    colors.map = plan::ColorMap::Cividis;
    std::vector<std::string> said;
    for (std::size_t i = 0; i < all.size(); ++i) {
        EXPECT_TRUE(isAmong(all, colors));
        said.push_back(stepColors(all, 1, colors));
    }
    EXPECT_EQ(said.front(), "colours: vertex");
    EXPECT_EQ(said[5], "colours: wind");
    EXPECT_EQ(said.back(), "colours: none");
    EXPECT_EQ(stepColors(all, -1, colors), "colours: wind");
    EXPECT_EQ(colors.map, plan::ColorMap::Cividis);
    model.fields = {{"rain", 0, 1}, {"wind", -2, 7}};
    model.bounds = {{0, -3, 0}, {1, 5, 1}};
    model.levels = {{10, 1, 1, 0.001, 0}, {5, 1, 1, 0.5, 0}};
    const auto ends = [&](const settings::ValueColors& of) { return widestEnds(of, model, {0, 2, 0}); };
    using Ends = std::array<double, 2>;
    EXPECT_EQ(ends(colors), (Ends{-2, 7})) << "of the wind";
    EXPECT_EQ(ends({ColorBy::Height}), (Ends{-3, 5}));
    EXPECT_EQ(ends({ColorBy::Slope}), (Ends{0, 90}));
    EXPECT_EQ(ends({ColorBy::Error}), (Ends{0.001, 0.5}));
    model.levels.pop_back();
    EXPECT_EQ(ends({ColorBy::Error}), (Ends{0.001, 0.002})) << "there is but one level";
    EXPECT_EQ(nameOf(colors), "wind");
    colors.field = "snow";
    EXPECT_FALSE(isAmong(all, colors));
    EXPECT_EQ(stepColors(all, 1, colors), "colours: vertex");
}

} // namespace
} // namespace gnomon::viewer
