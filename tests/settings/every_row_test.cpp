// Every row of the table of settings alone: what its text is, what is refused and in which words, what it changes.
#include "core/random.h"
#include "settings/limits.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace gnomon::settings {
namespace {

/// What a person who writes `text` behind the option of `name` is told; empty if it is taken.
std::string refusal(const std::string& name, const std::string& text) {
    try {
        named(name).parse(text);
        return {};
    } catch (const UsageError& error) {
        return error.message;
    }
}

/// The texts of all settings, by their names.
std::map<std::string, std::string> allTexts(const Settings& settings) {
    std::map<std::string, std::string> texts;
    for (const Setting& each : table())
        texts[each.name()] = each.text(settings);
    return texts;
}

/// What each row may be, beside what no row may be; texts as they are written back.
struct EveryRow {
    const char* name;
    const char* byDefault;
    std::vector<const char*> taken;
    std::vector<const char*> refused;
    const char* expected; // of a text, in the words of the refusal
};

constexpr const char* kSevenSections =
    "0,0,0,0,1,0;0,0,0,0,1,0;0,0,0,0,1,0;0,0,0,0,1,0;0,0,0,0,1,0;0,0,0,0,1,0;0,0,0,0,1,0";

/// Of those that say what is cut away and what lies under the model.
std::vector<EveryRow> sectionRows() {
    return {
        {"ground", "off", {"on", "off"}, {"", "plane"}, "on or off"},
        {"section",
         "",
         {"0,1.5,0,0,1,0", "0,0,0,0,0,1;1,2,3,-1,0,0.5"},
         {"", "0,0,0", "0,0,0,0,0,0", "0,0,0,0,1", "0,0,0,0,1,0,7", "a,0,0,0,1,0", kSevenSections},
         "PX,PY,PZ,NX,NY,NZ, a point and a direction of a length above 0, at most six times"},
        {"section-casters", "cut", {"cut", "keep"}, {"", "whole"}, "cut or keep"},
    };
}

/// Of the settings that say what is seen, and in which light.
std::vector<EveryRow> sceneRows() {
    return {
        {"size",
         "800x800",
         {"1x1", "16384x16384", "16384x1"},
         {"0x1", "16385x1", "1x16385", "800", "8 x 8", "-1x-1", "1e2x5", "99999999999x1"},
         "WxH, sides of at most 16384 pixels"},
        {"eye", "", {"0,0,0", "-1.5,2,1e+30"}, {"1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "a,b,c", "1;2;3"}, "x,y,z"},
        {"target", "", {"0,0,0", "1e-300,0,0"}, {"", "0", "1,2,", ",1,2"}, "x,y,z"},
        {"up",
         "",
         {"y", "-z", "auto", "0,-2,0", "0,0,1e-12"},
         {"0,0,0", "1e308,1e308,1e308", "0,1", "w", "+x"},
         "auto, x, y, z, -x, -y, -z or x,y,z, a direction of a finite length above 0"},
        {"view",
         "",
         {"front", "back", "left", "right", "top", "bottom", "iso"},
         {"", "side", "Front"},
         "front, back, left, right, top, bottom or iso"},
        {"fov-y", "", {"60", "0.001", "179.999"}, {"0", "180", "-60", "nan"}, "an angle above 0 and below 180 degrees"},
        {"projection", "", {"perspective", "orthographic"}, {"", "isometric"}, "perspective or orthographic"},
        {"shadow-near", "auto", {"auto", "0.5", "1e-15", "1e+15"}, {"0", "-1", "1e16", "inf", "Auto"}, nullptr},
        {"shadow-far", "auto", {"auto", "90"}, {"0", "1e-16", "far"}, nullptr},
        {"near-floor", "", {"0.01"}, {"auto", "0", "-0.01"}, "a distance from 1e-15 to 1e15"},
        {"light", "0.4,1,0.3", {"0,1,0", "-1,-1,-1"}, {"0,0,0", "up"}, "x,y,z, a direction of a finite length above 0"},
        {"sun",
         "",
         {"47.4,8.5,2026-06-21T12:00:00+02:00", "-90,180,1900-01-01T00:00:00+00:00"},
         {"", "47.4,8.5", "47.4,8.5,2026-06-21T12:00", "91,8.5,2026-06-21T12:00Z", "47.4,2026-06-21T12:00Z"},
         "LAT,LON,TIME, such as 47.4,8.5,2026-06-21T12:00+02:00"},
        {"light-at", "", {"0,0,0", "1.5,-2,1e+30"}, {"", "1,2", "1,2,3,4", "nan,0,0", "a,b,c"}, nullptr},
        {"north", "", {"0", "-12.5", "360"}, {"", "361", "nan", "east"}, "an angle from -360 to 360 degrees"},
        {"sun-angle", "", {"0", "0.53", "90"}, {"", "-1", "91", "wide"}, "an angle from 0 to 90 degrees"},
        {"light-error", "0.05", {"0.003", "0.5"}, {"0", "0.0029", "1", "e"}, "a number from 0.003 to 0.5"},
        {"sky",
         "0",
         {"64", "64,overcast", "4096"},
         {"", "-1", "4097", "64,", "64,blue"},
         "a whole number of directions from 0 to 4096, with ,uniform or ,overcast behind it"},
        {"max-triangles",
         "",
         {"1", "10k", "13M", "1G"},
         {"0", "-1", "k", "1.2.3", "none"},
         "a count such as 500k or 2M"},
        {"shading",
         "auto",
         {"auto", "lit", "headlight", "flat", "unlit"},
         {"Lit", "", "on"},
         "auto, lit, headlight, flat or unlit"},
        {"ambient", "1", {"0", "0.5", "10"}, {"-0.1", "10.5", "nan", "inf", "auto"}, "a number from 0 to 10"},
        {"background",
         "sky",
         {"sky", "white", "transparent", "#000000", "#12ab9f"},
         {"blue", "#fff", "#12345g", "123456", "#1234567", ""},
         "sky, white, transparent or a colour such as #336699"},
    };
}

/// Of all others.
std::vector<EveryRow> qualityRows() {
    return {
        {"eta", "", {"-1", "0", "0.25", "1"}, {"1.001", "-1.001", "auto", "nan"}, "a number from -1 to 1"},
        {"tsm-focus", "", {"auto", "2.5"}, {"0", "-1", "1e16"}, "auto or a distance from 1e-15 to 1e15"},
        {"split-lambda", "1", {"0", "0.5", "1"}, {"-0.1", "1.1", "self"}, "a number from 0 to 1"},
        {"empty-slices", "drop", {"drop", "keep"}, {"", "auto"}, "drop or keep"},
        {"max-aliasing", "4", {"0.5", "100"}, {"0", "-4", "inf"}, "a number above 0"},
        {"backend", "auto", {"auto", "software", "osmesa", "egl", "window"}, {"gpu", "", "Auto"}, nullptr},
        {"memory", "1G", {"512M", "1k", "3G"}, {"0", "-1G", "much", "1e30G"}, "a memory size such as 512M or 2G"},
        {"gpu-memory", "1G", {"64M"}, {"0", "G"}, "a memory size such as 512M or 2G"},
        {"error-pixels", "1", {"0.125", "64", "1000"}, {"0", "-1", "1px"}, "a number above 0"},
        {"shadows", "auto", {"off", "maps", "exact", "rays", "auto"}, {"on", "Maps", "ray"}, nullptr},
        {"warp", "auto", {"none", "lspsm", "psm", "tsm", "minimax", "auto", "log"}, {"eta", "given", ""}, nullptr},
        {"z-partitions", "4", {"auto", "1", "12"}, {"0", "13", "2.0", "-1"}, "auto or a whole number from 1 to 12"},
        {"face-partitions", "off", {"on", "off", "auto"}, {"yes", "1"}, nullptr},
        {"shadow-texels",
         "2048x2048",
         {"1x1", "16384x16384", "32768x8192"},
         {"16385x16384", "0x5", "2048"},
         "WxH, at most 16384x16384 texels, the largest texture"},
        {"filter", "0", {"0", "16"}, {"-1", "17", "2.5"}, "a whole number from 0 to 16"},
        {"cull-casters", "auto", {"auto", "on", "off", "receivers"}, {"true", "ON"}, "auto, on, off or receivers"},
        {"occlusion", "auto", {"on", "off", "auto"}, {"true", "yes"}, nullptr},
        {"stabilize", "off", {"on", "off"}, {"0", ""}, "on or off"},
    };
}

const std::vector<EveryRow>& rows() {
    static const std::vector<EveryRow> all = [] {
        std::vector<EveryRow> both = sceneRows();
        const std::vector<EveryRow> sections = sectionRows();
        both.insert(both.end(), sections.begin(), sections.end());
        const std::vector<EveryRow> more = qualityRows();
        both.insert(both.end(), more.begin(), more.end());
        return both;
    }();
    return all;
}

TEST(EveryRow, IsListedHere) {
    std::vector<std::string> unlisted;
    for (const Setting& each : table())
        if (std::none_of(rows().begin(), rows().end(), [&](const EveryRow& row) { return each.name() == row.name; }))
            unlisted.push_back(each.name());
    EXPECT_EQ(unlisted, (std::vector<std::string>{"camera", "shaders"})) << "names of files, which may be any text";
}

TEST(EveryRow, HasItsDefaultAndReadsItBack) {
    for (const EveryRow& row : rows()) {
        const Setting& setting = named(row.name);
        EXPECT_EQ(setting.text(Settings()), row.byDefault) << row.name;
        EXPECT_TRUE(setting.isDefault(Settings())) << row.name;
        if (std::string(row.byDefault).empty()) continue; // not given, which has no text
        EXPECT_EQ(refusal(row.name, row.byDefault), "");
        Settings settings;
        setting.set(settings, setting.parse(row.byDefault));
        EXPECT_EQ(allTexts(settings), allTexts(Settings())) << row.name;
    }
}

TEST(EveryRow, TakesItsEndsAndWritesThemAsTheyWere) {
    for (const EveryRow& row : rows())
        for (const char* text : row.taken) {
            ASSERT_EQ(refusal(row.name, text), "") << row.name;
            const Setting& setting = named(row.name);
            EXPECT_EQ(setting.text(setting.parse(text)), text) << row.name;
        }
}

TEST(EveryRow, RefusesWhatLiesBeyondInWordsThatNameTheOptionAndTheText) {
    for (const EveryRow& row : rows())
        for (const char* text : row.refused) {
            const std::string message = refusal(row.name, text);
            const std::string option = std::string("--") + row.name;
            EXPECT_TRUE(message.starts_with(option + ": expected ")) << row.name << " " << text << ": " << message;
            EXPECT_TRUE(message.ends_with(", found '" + std::string(text) + "'")) << message;
            if (row.expected == nullptr) continue;
            EXPECT_EQ(message, option + ": expected " + row.expected + ", found '" + text + "'");
        }
}

TEST(EveryRow, OfWordsNamesAllOfThemToWhomItRefuses) {
    for (const Setting& each : table()) {
        if (each.kind() != Kind::Words) continue;
        for (const std::string& word : each.words())
            EXPECT_NE(refusal(each.name(), "no such word").find(word), std::string::npos)
                << each.name() << " does not offer " << word;
    }
}

TEST(EveryRow, ChangesItselfAlone) {
    for (const EveryRow& row : rows())
        for (const char* text : row.taken) {
            Settings settings;
            named(row.name).set(settings, named(row.name).parse(text));
            auto expected = allTexts(Settings());
            expected[row.name] = text;
            EXPECT_EQ(allTexts(settings), expected) << row.name << " " << text;
        }
}

TEST(EveryRow, OfferedByTheWindowHasEndsThatItTakes) {
    for (const Setting& each : table()) {
        const Offer& offer = each.description().offer;
        const bool isNumber = each.kind() == Kind::Whole || each.kind() == Kind::WholeOrAuto ||
                              each.kind() == Kind::Number || each.kind() == Kind::Size;
        if (offer.title.empty() || !isNumber) continue;
        EXPECT_LT(offer.min, offer.max) << each.name();
        for (const double end : {offer.min, offer.max}) {
            std::string value = shortest(end);
            if (each.kind() == Kind::Size) value.append("x").append(shortest(end));
            EXPECT_EQ(refusal(each.name(), value), "");
        }
        for (const int step : offer.steps) {
            EXPECT_EQ(refusal(each.name(), std::to_string(step)), "");
            EXPECT_TRUE(step >= offer.min && step <= offer.max) << each.name();
        }
    }
}

TEST(EveryRow, IsCalledInALogAsItsOptionIsButForDashes) {
    for (const Setting& each : table()) {
        EXPECT_EQ(each.option(), "--" + each.name());
        std::string column = each.column();
        EXPECT_EQ(column.size(), each.name().size());
        std::replace(column.begin(), column.end(), '_', '-');
        EXPECT_EQ(column, each.name());
    }
}

TEST(EveryRow, StatedByABenchIsNotSweptByIt) {
    for (const Setting& each : table())
        EXPECT_FALSE(each.description().isSwept && !each.description().statedAs.empty()) << each.name();
    EXPECT_EQ(named("shadow-near").description().statedAs, named("shadow-far").description().statedAs);
}

TEST(EveryRow, ChangesThePictureButForThoseThatSayTheyDoNot) {
    std::set<std::string> timeAlone;
    for (const Setting& each : table())
        if (!each.description().changesPicture) timeAlone.insert(each.name());
    EXPECT_EQ(
        timeAlone,
        (std::set<std::string>{"cull-casters", "gpu-memory", "occlusion"})); // which are rendered in tests/task
    Settings a;
    Settings b;
    b.quality.cullCasters = plan::CasterCulling::Off;
    b.quality.occlusion = plan::Choice::Off;
    b.gpuMemory = mebibytes(100);
    EXPECT_TRUE(drawAlike(a, b));
    EXPECT_FALSE(areAlike(a, b)) << "a bench sweeps the culling";
    b.quality.filter = 2;
    EXPECT_FALSE(drawAlike(a, b));
    a.quality.filter = 2;
    a.eye = glm::dvec3(1);
    EXPECT_FALSE(drawAlike(a, b));
}

} // namespace
} // namespace gnomon::settings
