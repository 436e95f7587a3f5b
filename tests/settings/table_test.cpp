// The table of settings: every row reads what it writes, sweeps, and steps within what it offers.
#include "settings/axes.h"
#include "settings/limits.h"
#include "settings/step.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace gnomon::settings {
namespace {

TEST(SettingsTable, EveryNameIsThereOnceWithFormAndHelp) {
    std::set<std::string> names;
    for (const Setting& setting : table()) {
        EXPECT_TRUE(names.insert(setting.name()).second) << setting.name();
        EXPECT_NE(setting.description().form, "") << setting.name();
        EXPECT_NE(setting.description().help, "") << setting.name();
        EXPECT_EQ(&named(setting.name()), &setting);
        EXPECT_EQ(setting.column().find('-'), std::string::npos);
    }
    EXPECT_GE(names.size(), 28U); // those of CONTRACT.md
}

TEST(SettingsTable, WhatIsWrittenReadsBack) {
    for (const Setting& setting : table()) {
        const std::string text = setting.text(Settings());
        if (text.empty()) continue; // not given
        Settings settings;
        setting.set(settings, setting.parse(text));
        EXPECT_TRUE(setting.isDefault(settings)) << setting.name();
        for (const std::string& word : setting.words()) {
            setting.set(settings, setting.parse(word));
            EXPECT_EQ(setting.text(settings), word) << setting.name();
        }
        if (setting.kind() == Kind::Other) continue; // any text will do
        EXPECT_THROW(setting.parse("no such value"), UsageError) << setting.name();
    }
}

TEST(SettingsTable, TheDefaultsAreThoseOfAFrame) {
    const Settings settings;
    EXPECT_EQ(named("shadows").text(settings), "auto");
    EXPECT_EQ(named("warp").text(settings), "auto");
    EXPECT_EQ(named("z-partitions").text(settings), "4");
    EXPECT_EQ(named("shadow-texels").text(settings), "2048x2048");
    EXPECT_EQ(named("memory").text(settings), "1G");
    EXPECT_EQ(named("light").text(settings), "0.4,1,0.3");
    EXPECT_EQ(named("eta").text(settings), "");
    EXPECT_EQ(named("shadow-near").text(settings), "auto");
}

TEST(SettingsTable, OptionsToPasteAreThoseThatAreNotTheDefault) {
    Settings settings;
    settings.cameraFile = "it's mine.json";
    settings.quality.filter = 3;
    EXPECT_EQ(optionsToPaste(settings, true), "--filter 3");
    EXPECT_EQ(optionsToPaste(settings, false), R"(--camera 'it'\''s mine.json')");
    EXPECT_FALSE(areAlike(settings, Settings()));
    settings.quality.filter = 0;
    EXPECT_TRUE(areAlike(settings, Settings()));
}

TEST(SettingsTable, ShadowsThatAreLeftOpenAreMapsWhereOneOfTheirOptionsIsGiven) {
    std::set<std::string> asking;
    for (const Setting& each : table())
        if (asksForMaps(each)) asking.insert(each.name());
    EXPECT_EQ(
        asking,
        (std::set<std::string>{
            "eta",
            "empty-slices",
            "tsm-focus",
            "split-lambda",
            "max-aliasing",
            "warp",
            "z-partitions",
            "face-partitions",
            "shadow-texels",
            "filter",
            "cull-casters",
            "stabilize"}));
    Settings settings;
    askForMaps(settings);
    EXPECT_EQ(named("shadows").text(settings), "maps");
    EXPECT_EQ(optionsToPaste(settings, true), "--shadows maps") << "four slices, as by default, would not say so";
    named("shadows").set(settings, named("shadows").parse("exact"));
    EXPECT_EQ(named("shadows").text(settings), "exact");
}

TEST(Axes, CombineTheLastFastest) {
    const Setting& filter = named("filter");
    const Setting& culling = named("cull-casters");
    const std::vector<Axis> axes = {
        parseAxis(filter, filter.option(), "0,2"), parseAxis(culling, culling.option(), "on,off")};
    std::string all;
    for (const Settings& settings : combinations(Settings(), axes))
        all += filter.text(settings) + culling.text(settings) + " ";
    EXPECT_EQ(all, "0on 0off 2on 2off ");
    EXPECT_EQ(combinations(Settings(), {}).size(), 1U);
    EXPECT_THROW(parseAxis(filter, "--filter", "2,3,2"), UsageError);
    EXPECT_THROW(parseAxis(named("error-pixels"), "--error-pixels", "1,1.0"), UsageError) << "the same number";
}

/// The value of `name` after `steps` steps, taken one by one.
std::string stepped(const char* name, int steps, Settings settings = {}) {
    for (int i = 0; i < std::abs(steps); ++i)
        step(named(name), settings, steps > 0 ? 1 : -1);
    return named(name).text(settings);
}

TEST(Step, StaysWithinWhatIsOffered) {
    EXPECT_EQ(stepped("z-partitions", 50), std::to_string(kMaxSlices));
    EXPECT_EQ(stepped("z-partitions", -50), "1");
    EXPECT_EQ(stepped("shadow-texels", 1), "4096x2048");
    EXPECT_EQ(stepped("shadow-texels", 2), "4096x4096");
    EXPECT_EQ(stepped("shadow-texels", 50), "8192x8192");
    EXPECT_EQ(stepped("shadow-texels", -50), "256x256");
    EXPECT_EQ(stepped("error-pixels", 50), "64");
    EXPECT_EQ(stepped("error-pixels", -50), "0.125");
    EXPECT_EQ(stepped("filter", 3), "5");
    EXPECT_EQ(stepped("filter", 4), "0");
}

TEST(Step, WordsAndSwitchesGoRound) {
    EXPECT_EQ(stepped("warp", 1), "log");
    EXPECT_EQ(stepped("warp", 2), "none");
    EXPECT_EQ(stepped("warp", -1), "minimax");
    EXPECT_EQ(stepped("warp", static_cast<int>(shadow::kWarpRules.size())), "auto");
    EXPECT_EQ(stepped("face-partitions", 2), "auto");
    EXPECT_EQ(stepped("stabilize", 1), "on");
    EXPECT_EQ(stepped("stabilize", 2), "off");
    Settings eta;
    eta.quality.warp.rule = shadow::WarpRule::Eta;
    EXPECT_EQ(named("warp").text(eta), "") << "it has no word";
    EXPECT_EQ(stepped("warp", 1, eta), "none");
}

TEST(Step, AutoIsTurnedOnAndOff) {
    Settings settings;
    step(named("z-partitions"), settings, 0);
    EXPECT_EQ(inWords(named("z-partitions"), settings), "slices: auto");
    step(named("z-partitions"), settings, 0);
    EXPECT_EQ(inWords(named("z-partitions"), settings), "slices: 4");
    step(named("error-pixels"), settings, 1);
    EXPECT_EQ(inWords(named("error-pixels"), settings), "error pixels: 1.41");
}

} // namespace
} // namespace gnomon::settings
