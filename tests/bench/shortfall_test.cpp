// What is said of pictures that miss the error that was asked for: one line, in every mode.
#include "task/render.h"
#include "telemetry/shortfall.h"
#include "tests/bench/small_bench.h"

#include <gtest/gtest.h>

#include <filesystem>

#include <unistd.h>

namespace gnomon::bench {
namespace {

std::string pictureName() {
    return testing::TempDir() + "gnomon_shortfall_" + std::to_string(::getpid()) + "_%d.png";
}

using plan::ShadowMode;

/// What is told of a picture of the hills, or of three around them.
std::vector<std::string> told(ShadowMode shadows, Bytes memory, int samples, bool isSeries) {
    std::vector<std::string> lines;
    settings::Settings settings = smallSettings();
    settings.quality.shadows = shadows;
    settings.memory = memory;
    const auto warn = [&](const std::string& line) { lines.push_back(line); };
    NoProgress progress;
    settings::Request request{model(), settings, {.picture = pictureName(), .samples = samples}};
    if (isSeries) request.output.turntable = 3;
    task::RenderTask job = task::renderTask(request);
    job.warn = warn;
    task::render(job, progress);
    for (const auto& file : std::filesystem::directory_iterator(testing::TempDir()))
        if (file.path().string().find("gnomon_shortfall_" + std::to_string(::getpid())) != std::string::npos)
            std::filesystem::remove(file.path());
    return lines;
}

TEST(Shortfall, IsToldInOneLineInEveryMode) {
    for (const ShadowMode shadows : {ShadowMode::Maps, ShadowMode::Exact, ShadowMode::Rays, ShadowMode::Off})
        for (const int samples : {1, 2}) {
            const bool isSeries = samples == 2;
            SCOPED_TRACE(std::string(wordOf(plan::kShadowModes, shadows)) + " " + std::to_string(samples));
            EXPECT_TRUE(told(shadows, gibibytes(1), samples, isSeries).empty());
            const std::vector<std::string> lines = told(shadows, memoryFor(0.15, shadows, samples), samples, isSeries);
            ASSERT_EQ(lines.size(), 1U);
            EXPECT_NE(lines[0].find("coarser than asked for"), std::string::npos) << lines[0];
            EXPECT_NE(lines[0].find("--memory"), std::string::npos) << lines[0];
        }
}

TEST(Shortfall, SaysWhatIsMissed) {
    telemetry::Shortfall shortfall;
    EXPECT_EQ(shortfall.text(), "");
    shortfall.add({1, 1, 0, false});
    shortfall.add({1, 5, 0, true});
    EXPECT_EQ(shortfall.text(), "") << "damage has been told";
    telemetry::Shortfall capped;
    capped.add({1, 2.5, 0, false});
    EXPECT_EQ(
        capped.text(),
        "the model is drawn coarser than asked for: the error is up to 2.5 pixels instead of 1; the cap of triangles "
        "allows no more");
    shortfall.add({1, 200, 57, false});
    shortfall.add({1, 0.9, 3, false});
    EXPECT_EQ(
        task::shortfallLine(shortfall),
        "the model is drawn coarser than asked for: the error is up to 200 pixels instead of 1; up to 57 pages do not "
        "fit "
        "into the page memory (--memory)");
}

} // namespace
} // namespace gnomon::bench
