#include "core/file.h"
#include "report/page.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon::report {
namespace {

Report exampleReport() {
    Report report;
    report.model = "</script><b>model";
    report.context = {{"cores", "2"}, {"light", "0.4,1,0.3"}};
    for (int maps : {1, 2, 4, 8}) {
        RunSummary run;
        run.name = "maps " + std::to_string(maps);
        run.options = "--z-partitions " + std::to_string(maps);
        run.settings = {{"shadow_maps", std::to_string(maps)}, {"warp", "auto"}};
        run.shadowMaps = maps;
        run.p50Ms = 100 + 5 * maps;
        run.p95Ms = run.p50Ms * 1.1;
        run.p99Ms = run.p50Ms * 1.2;
        if (maps > 1) run.noise = 0.01 * maps;
        run.stages = {0.1, 0.3, 0.2, 0, 20.0 + maps, 80};
        run.errors = {
            {ErrorKind::AliasingBound, 30.0 / maps},
            {ErrorKind::MeasuredAliasing, 25.0 / maps},
            {ErrorKind::WrongShadow, 0.02 / maps},
            {ErrorKind::ShadowEdge, 12.0 / maps}};
        run.frameMs = {run.p50Ms, run.p50Ms + 1, run.p50Ms - 1};
        report.runs.push_back(run);
        report.storage.push_back({"ZP + W", maps, 1000.0 / maps});
    }
    for (RunSummary& run : report.runs) {
        run.scheme = run.shadowMaps == 1 ? "map+w" : "zp" + std::to_string(run.shadowMaps) + "+w";
        run.errors[ErrorKind::WrongPixels] = 0.01 / run.shadowMaps;
        run.errorRanges[ErrorKind::WrongPixels] = {0.005 / run.shadowMaps, 0.02 / run.shadowMaps};
        run.minStages = run.maxStages = run.stages;
        run.maxStages.shadow *= 1.2;
        for (const double ms : run.frameMs)
            run.frameRanges.push_back({0.95 * ms, 1.1 * ms});
    }
    for (const char* cells : {"map+w", "map", "zp4+w", "zp4"}) {
        RunSummary run = report.runs[0];
        run.name = std::string("exact ") + cells;
        run.options = "--shadows exact";
        run.settings = {{"shadow_maps", "4"}, {"warp", "auto"}, {"cells", cells}};
        run.scheme = cells;
        run.shadowMaps = 0;
        run.p50Ms = 70 + static_cast<double>(run.name.size());
        run.errors = {{ErrorKind::WrongPixels, 0}};
        report.runs.push_back(run);
    }
    report.pictures.push_back({"maps 1", "picture", {0x89, 'P', 'N', 'G'}});
    report.pictures.push_back({"maps 4", "picture", {0x89, 'P', 'N', 'G', 4}});
    report.pictures.push_back({"maps 4", "reference", {0x89, 'P', 'N', 'G', 5}});
    return report;
}

nlohmann::json embeddedData(const std::string& html) {
    const std::string begin = "id=\"data\">";
    const auto from = html.find(begin) + begin.size();
    return nlohmann::json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(ReportPage, LeadsWithWrongPixels) {
    const auto data = embeddedData(page(exampleReport()));
    EXPECT_EQ(data["leading_error"], "wrong_pixels_all");
    EXPECT_EQ(
        data["sentences"][0],
        "Exact shadows are faster and more accurate than four maps: 0% instead of 0.25% wrong pixels, and 81 ms "
        "instead of "
        "120 ms per frame (assumed noise 10%).");
    EXPECT_EQ(data["recommended"]["run"], 5) << "the fastest of the exact runs";
    Report partly = exampleReport();
    for (RunSummary& run : partly.runs)
        run.errors.erase(ErrorKind::WrongPixels);
    EXPECT_EQ(embeddedData(page(partly))["leading_error"], "wrong_pixels_all") << "exact shadows have 0";
    partly.runs.resize(4);
    EXPECT_EQ(embeddedData(page(partly))["leading_error"], "promised_aliasing");
}

TEST(ReportPage, CarriesItsDataUnharmed) {
    const Report report = exampleReport();
    const auto data = embeddedData(page(report));
    EXPECT_EQ(data, pageData(report));
    EXPECT_EQ(data["model"], report.model);
    EXPECT_EQ(data["pictures"][0]["src"], "data:image/png;base64,iVBORw==");
}

// The browser test opens the file that this one leaves.
TEST(ReportPage, AsksNothingOfAnyNetwork) {
    const std::string html = page(exampleReport());
    if (const char* path = std::getenv("GNOMON_EXAMPLE_PAGE")) writeTextFile(path, html);
    EXPECT_EQ(html.find("src=\"http"), std::string::npos);
    EXPECT_EQ(html.find("href=\"http"), std::string::npos);
    EXPECT_EQ(html.find("/*PLOT*/"), std::string::npos);
    EXPECT_EQ(html.find("/*JS*/"), std::string::npos);
}

// From the page's own table, as a reader would check it.
TEST(ReportPage, NoRunOfTheTableDominatesTheFront) {
    const auto data = embeddedData(page(exampleReport()));
    for (const auto& [kind, front] : data["fronts"].items()) {
        for (const auto& index : front) {
            const auto& member = data["runs"][index.get<std::size_t>()];
            for (const auto& run : data["runs"]) {
                if (!run["errors"].contains(kind)) continue;
                const bool faster = run["p50"] < member["p50"];
                const bool better = run["errors"][kind] < member["errors"][kind];
                const bool nowhereWorse = run["p50"] <= member["p50"] && run["errors"][kind] <= member["errors"][kind];
                EXPECT_FALSE(nowhereWorse && (faster || better)) << kind;
            }
        }
    }
}

} // namespace
} // namespace gnomon::report
