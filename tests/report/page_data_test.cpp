// What a page carries of a report, field by field, whatever its names hold; and the page around it.
#include "core/random.h"
#include "report/accuracy_cost.h"
#include "report/page.h"
#include "report/page_assets.h"
#include "report/recommendation.h"
#include "report/sentences.h"
#include "report/sun_page.h"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <set>

namespace gnomon::report {
namespace {

/// The bytes that a text of base64 stands for (RFC 4648), four letters at a time.
std::vector<std::uint8_t> decoded(const std::string& text) {
    EXPECT_EQ(text.size() % 4, 0U);
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i + 3 < text.size(); i += 4) {
        std::uint32_t word = 0;
        std::size_t padding = 0;
        for (std::size_t j = 0; j < 4; ++j) {
            const std::size_t digit = letters.find(text[i + j]);
            padding += text[i + j] == '=' ? 1 : 0;
            EXPECT_TRUE(digit != std::string::npos || (text[i + j] == '=' && i + 4 == text.size() && j >= 2));
            word = word * 64 + (digit == std::string::npos ? 0 : static_cast<std::uint32_t>(digit));
        }
        for (std::size_t j = 0; j + padding < 3; ++j)
            bytes.push_back(static_cast<std::uint8_t>(word >> (16 - 8 * j)));
    }
    return bytes;
}

std::string anyName(Random& random) {
    static const std::array<const char*, 9> kParts = {
        "</script>", "<!--", "\"", "'", "/*DATA*/", "/*JS*/", "model", "\\u003c", "\n"};
    std::string name;
    for (std::uint64_t parts = random.below(4); parts > 0; --parts)
        name += kParts[random.below(kParts.size())];
    return name;
}

Report anyReport(Random& random) {
    Report report;
    report.model = anyName(random);
    report.context = {{"light", anyName(random)}, {"memory_cap", "1G"}};
    report.csvFile = random.below(2) == 0 ? "" : "frames.csv";
    report.jsonFile = "bench.json";
    for (std::uint64_t i = random.below(6); i > 0; --i) {
        RunSummary run;
        run.name = std::to_string(i) + anyName(random);
        run.options = anyName(random);
        run.settings = {{"warp", anyName(random)}};
        run.scheme = anyName(random);
        run.shadowMaps = static_cast<int>(i);
        run.p50Ms = random.uniform(1, 50);
        run.p95Ms = run.p50Ms + random.unit();
        run.p99Ms = run.p95Ms + random.unit();
        if (random.below(2) == 0) run.noise = random.unit();
        run.stages = {random.unit(), random.unit(), random.unit(), random.unit(), random.unit(), random.unit()};
        run.imageTriangles = random.uniform(0, 1e6);
        run.shadowTriangles = random.uniform(0, 1e6);
        for (const ErrorKind kind : kErrorKinds)
            if (random.below(3) != 0) run.errors[kind] = random.unit();
        if (random.below(2) == 0) run.crawl = random.unit();
        run.storageFactor = random.uniform(1, 100);
        run.isBoundKept = random.below(2) == 0;
        run.frameMs = {random.unit(), random.unit()};
        run.minStages.shadow = random.unit();
        run.maxStages.shadow = random.unit();
        run.errorRanges[ErrorKind::WrongPixels] = {random.unit(), random.unit()};
        run.frameRanges = {{random.unit(), random.unit()}, {random.unit(), random.unit()}};
        report.runs.push_back(run);
        report.storage.push_back({anyName(random), static_cast<int>(i), random.uniform(1, 100)});
        std::vector<std::uint8_t> png(random.below(10));
        for (std::uint8_t& byte : png)
            byte = static_cast<std::uint8_t>(random.below(256));
        report.pictures.push_back({run.name, "picture", png});
    }
    return report;
}

TEST(PageData, HasEveryFigureOfEveryRun) {
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        const Report report = anyReport(random);
        const nlohmann::json data = pageData(report);
        ASSERT_EQ(data["runs"].size(), report.runs.size());
        for (std::size_t i = 0; i < report.runs.size(); ++i) {
            const RunSummary& run = report.runs[i];
            const nlohmann::json& told = data["runs"][i];
            EXPECT_EQ(told["name"], run.name);
            EXPECT_EQ(told["options"], run.options);
            EXPECT_EQ(told["settings"], nlohmann::json(run.settings));
            EXPECT_EQ(told["shadow_maps"], run.shadowMaps);
            EXPECT_EQ(told["p50"], run.p50Ms);
            EXPECT_EQ(told["p95"], run.p95Ms);
            EXPECT_EQ(told["scheme"], run.scheme);
            EXPECT_EQ(told["p99"], run.p99Ms);
            EXPECT_EQ(told["noise"].is_null(), !run.noise);
            EXPECT_EQ(told["crawl"].is_null(), run.crawl < 0);
            EXPECT_EQ(told["stages"]["plan"], run.stages.plan);
            EXPECT_EQ(told["stages"]["select"], run.stages.select);
            EXPECT_EQ(told["stages"]["cull"], run.stages.cull);
            EXPECT_EQ(told["stages"]["stream"], run.stages.stream);
            EXPECT_EQ(told["stages"]["shadow"], run.stages.shadow);
            EXPECT_EQ(told["stages"]["image"], run.stages.image);
            EXPECT_EQ(told["image_triangles"], run.imageTriangles);
            EXPECT_EQ(told["shadow_triangles"], run.shadowTriangles);
            EXPECT_EQ(told["storage_factor"], run.storageFactor);
            EXPECT_EQ(told["bound_kept"], run.isBoundKept);
            EXPECT_EQ(told["frames"], nlohmann::json(run.frameMs));
            EXPECT_EQ(told["frame_ranges"][1][1], run.frameRanges[1].high);
            EXPECT_EQ(told["error_ranges"]["wrong_pixels_all"][0], run.errorRanges.at(ErrorKind::WrongPixels).low);
            EXPECT_EQ(told["stage_ranges"].is_null(), !run.noise);
            if (run.noise) {
                EXPECT_EQ(told["stage_ranges"]["shadow"][0], run.minStages.shadow);
                EXPECT_EQ(told["stage_ranges"]["shadow"][1], run.maxStages.shadow);
            }
            EXPECT_EQ(told["errors"].size(), run.errors.size());
            for (const auto& [kind, value] : run.errors)
                EXPECT_EQ(told["errors"][std::string(key(kind))], value);
        }
    }
}

/// Compares a step function of a limit with `expected` at 200 limits from 0 to `max`.
template <class Expected>
void expectSteps(const nlohmann::json& steps, double max, Expected expected) {
    for (int i = 0; i < 200; ++i) {
        const double limit = max * i / 200;
        std::optional<std::size_t> run;
        for (const nlohmann::json& step : steps)
            if (step[0].get<double>() <= limit) run = step[1].get<std::size_t>();
        EXPECT_EQ(run, expected(limit)) << limit;
    }
}

TEST(PageData, HasFrontsSentencesAndPointsAsTheyAreReckoned) {
    Random random(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Report report = anyReport(random);
        const nlohmann::json data = pageData(report);
        EXPECT_EQ(data["sentences"], nlohmann::json(sentences(report.runs)));
        EXPECT_EQ(data["leading_error"], key(leadingError(report.runs)));
        const auto recommended = recommend(report.runs);
        const nlohmann::json& told = data["recommended"];
        EXPECT_EQ(told.contains("run"), recommended.has_value());
        EXPECT_EQ(told["reason"], recommended ? reasonFor(*recommended, report.runs) : reasonForNone(report.runs));
        if (recommended) {
            const std::string command = told["command"];
            EXPECT_EQ(told["run"], *recommended);
            EXPECT_TRUE(command.starts_with("gnomon render ")) << command;
            EXPECT_TRUE(command.ends_with(report.runs[*recommended].options)) << command;
        }
        expectSteps(data["budget_steps"], 60, [&](double ms) { return recommend(report.runs, {std::nullopt, ms}); });
        expectSteps(data["bound_steps"], 1, [&](double share) {
            return recommend(report.runs, {share, std::nullopt});
        });
        ASSERT_EQ(data["errors"].size(), kErrorKinds.size());
        std::set<std::string> names;
        for (const nlohmann::json& error : data["errors"])
            names.insert(error["key"].get<std::string>());
        EXPECT_EQ(data["errors"][0]["key"], "wrong_pixels_all");
        for (const ErrorKind kind : kErrorKinds) {
            const std::string name(key(kind));
            EXPECT_TRUE(names.contains(name));
            EXPECT_EQ(data["fronts"][name], nlohmann::json(paretoFront(report.runs, kind)));
        }
        EXPECT_EQ(data["csv"], report.csvFile);
        EXPECT_EQ(data["json"], report.jsonFile);
        EXPECT_EQ(data["context"], nlohmann::json(report.context));
        ASSERT_EQ(data["storage"].size(), report.storage.size());
        for (std::size_t i = 0; i < report.storage.size(); ++i) {
            EXPECT_EQ(data["storage"][i]["scheme"], report.storage[i].scheme);
            EXPECT_EQ(data["storage"][i]["maps"], report.storage[i].maps);
            EXPECT_EQ(data["storage"][i]["S"], report.storage[i].storageFactor);
        }
    }
}

TEST(PageData, QuotesTheModelOfTheCommandThatItRecommends) {
    Report report;
    RunSummary& run = report.runs.emplace_back();
    run.errors[ErrorKind::WrongPixels] = 0.1;
    run.options = "--z-partitions 1";
    report.context["model"] = "plant.gnm";
    EXPECT_EQ(pageData(report)["recommended"]["command"], "gnomon render plant.gnm -o picture.png --z-partitions 1");
    report.context["model"] = "the plant's.gnm";
    EXPECT_EQ(
        pageData(report)["recommended"]["command"],
        "gnomon render 'the plant'\\''s.gnm' -o picture.png --z-partitions 1");
}

TEST(PageData, HasPicturesThatDecodeToTheirBytes) {
    Random random(3);
    std::set<std::size_t> lengths;
    for (int trial = 0; trial < 100; ++trial) {
        const Report report = anyReport(random);
        const nlohmann::json pictures = pageData(report)["pictures"];
        ASSERT_EQ(pictures.size(), report.pictures.size());
        for (std::size_t i = 0; i < report.pictures.size(); ++i) {
            const std::string source = pictures[i]["src"].get<std::string>();
            const std::string begin = "data:image/png;base64,";
            ASSERT_TRUE(source.starts_with(begin));
            EXPECT_EQ(decoded(source.substr(begin.size())), report.pictures[i].png);
            EXPECT_EQ(pictures[i]["run"], report.pictures[i].run);
            lengths.insert(report.pictures[i].png.size() % 3);
        }
    }
    EXPECT_EQ(lengths.size(), 3U) << "with and without padding";
}

TEST(Page, EndsItsDataOnlyWhereTheDataEndsWhateverNamesSay) {
    Random random(4);
    for (int trial = 0; trial < 5; ++trial) {
        Report report = anyReport(random);
        report.model = "</script><!--<script>/*CSS*//*PLOT*//*JS*//*DATA*/" + anyName(random);
        const std::string html = page(report);
        const std::string begin = "id=\"data\">";
        const std::size_t from = html.find(begin);
        ASSERT_NE(from, std::string::npos);
        const std::size_t to = html.find('<', from + begin.size());
        ASSERT_TRUE(html.compare(to, 9, "</script>") == 0) << "no other element begins within the data";
        EXPECT_EQ(nlohmann::json::parse(html.substr(from + begin.size(), to - from - begin.size())), pageData(report));
    }
}

TEST(Page, HasAllItsPartsWhole) {
    const std::string html = page(Report());
    for (const std::string_view part : {kPageCss, kPicturesJs, kPageJs, kPlotJs}) {
        EXPECT_GT(part.size(), 100U);
        EXPECT_NE(html.find(part), std::string::npos);
    }
    for (const char* mark : {"/*CSS*/", "/*PLOT*/", "/*DATA*/", "/*JS*/"}) {
        EXPECT_NE(kPageHtml.find(mark), std::string_view::npos) << mark;
        EXPECT_EQ(kPageHtml.find(mark), kPageHtml.rfind(mark)) << mark << " stands twice";
        EXPECT_EQ(html.find(mark), std::string::npos) << mark;
    }
}

TEST(Page, OfNamesThatAreNoTextOrTurnTextIsPrintable) {
    Report report;
    report.model = "\xC3\x28.gnm \xE2\x80\xAE";
    const std::string html = page(report);
    EXPECT_NE(html.find(R"(\\xc3(.gnm \\xe2\\x80\\xae)"), std::string::npos);
    SunPage sun;
    sun.about = report.model;
    EXPECT_NE(sunPage(sun).find(R"(\\xc3(.gnm \\xe2\\x80\\xae)"), std::string::npos);
}

TEST(ErrorKinds, HaveAKeyAndALabelEach) {
    std::set<std::string_view> names;
    for (const ErrorKind kind : kErrorKinds) {
        EXPECT_TRUE(names.insert(key(kind)).second);
        EXPECT_TRUE(names.insert(label(kind)).second);
        for (const char c : key(kind))
            EXPECT_TRUE(
                c == '_' || std::islower(static_cast<unsigned char>(c)) || std::isdigit(static_cast<unsigned char>(c)));
        EXPECT_NE(label(kind).find('('), std::string_view::npos) << "its unit";
    }
}

TEST(SunPage, RunsOfLitPixelsReadBackAndFitTheirScript) {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        std::vector<std::uint8_t> isLit;
        const std::size_t size = random.below(4000);
        while (isLit.size() < size)
            isLit.insert(isLit.end(), random.below(random.below(3) == 0 ? 900 : 5) + 1, random.below(2) == 0 ? 0 : 1);
        std::vector<std::uint8_t> read; // as the page's script reads it
        const std::vector<std::uint8_t> runs = litRuns(isLit);
        std::uint8_t value = 0;
        for (std::size_t at = 0; at < runs.size(); value ^= 1U) {
            std::size_t length = 0;
            std::size_t scale = 1;
            for (; runs[at] >= 128; scale *= 128)
                length += (runs[at++] - 128U) * scale;
            length += runs[at++] * scale;
            read.insert(read.end(), length, value);
        }
        ASSERT_EQ(read, isLit);
    }
}

TEST(SunPage, HoldsAllItsDataAndNothingThatEndsItsScript) {
    SunPage shown;
    shown.about = "</script><b>";
    shown.width = shown.height = 2;
    shown.steps = {{"2026-06-21T12:00", litRuns({0, 1, 1, 0})}};
    const std::string text = sunPage(shown);
    EXPECT_EQ(text.find("</script><b>"), std::string::npos);
    EXPECT_NE(text.find("\"lit\":\"AQIB\""), std::string::npos) << "runs of 1, 2 and 1";
    EXPECT_EQ(text.find("http"), std::string::npos) << "asks nothing of any network";
}

} // namespace
} // namespace gnomon::report
