// What the view and quality options make of each other.
#include "app/report_runs.h"
#include "app/view_options.h"
#include "core/file.h"
#include "gl/shader_library.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

namespace gnomon::app {
namespace {

TEST(ViewOptions, TheRunsOfAReportContradictNoWarpThatIsAskedFor) {
    ViewOptions warped;
    warped.swept.warp = "lspsm";
    warped.isWarpGiven = true;
    ViewOptions eta;
    eta.eta = "0.5";
    ViewOptions focus;
    focus.swept.warp = "tsm";
    focus.isWarpGiven = true;
    focus.tsmFocus = "2";
    for (const ViewOptions& options : {ViewOptions(), warped, eta, focus})
        for (const bool isQuick : {false, true}) {
            const bool isWarpOpen = options.eta.empty() && options.tsmFocus.empty();
            const std::vector<BenchRun> runs = reportRuns(options.swept, isQuick, isWarpOpen);
            std::set<std::string> names;
            for (const BenchRun& run : runs) {
                EXPECT_NO_THROW(qualityOf(options, run.settings)) << run.options;
                EXPECT_TRUE(names.insert(run.name).second) << run.name;
                EXPECT_TRUE(isWarpOpen || run.settings.warp == options.swept.warp) << run.name;
            }
            EXPECT_GT(runs.size(), 5U);
        }
}

/// The words that a shell makes of `text`.
std::vector<std::string> shellWords(const std::string& text) {
    std::FILE* shell = ::popen(("printf '%s\\n' " + text).c_str(), "r");
    std::string printed;
    for (int c = std::fgetc(shell); c != EOF; c = std::fgetc(shell))
        printed += static_cast<char>(c);
    ::pclose(shell);
    std::vector<std::string> words;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);)
        words.push_back(line);
    return words;
}

TEST(ViewOptions, WhatIsPastedIsWhatWasGiven) {
    EXPECT_EQ(plainOptionsToPaste(ViewOptions()), "");
    const std::string folder = testing::TempDir() + "it's a folder";
    for (const auto& [path, text] : gl::kEmbeddedShaders) {
        const std::filesystem::path shader = std::filesystem::path(folder) / path;
        std::filesystem::create_directories(shader.parent_path());
        writeTextFile(shader.string(), std::string(text));
    }
    // clang-format off
    const std::vector<std::string> given = {
        "--size", "64x48", "--near", "0.5", "--far", "90", "--near-floor", "0.01", "--light", "-1,2,0.5",
        "--max-triangles", "10k", "--eta", "-0.25", "--split-lambda", "0.5", "--max-aliasing", "2", "--backend",
        "software", "--memory", "512M", "--gpu-memory", "2G", "--shaders", folder};
    // clang-format on
    const auto parsed = [](std::vector<std::string> words) {
        ViewOptions options;
        CLI::App command;
        addViewOptions(command, options);
        std::reverse(words.begin(), words.end()); // as CLI11 takes a vector
        command.parse(words);
        return options;
    };
    const ViewOptions options = parsed(given);
    EXPECT_EQ(shellWords(plainOptionsToPaste(options)), given);
    EXPECT_EQ(plainOptionsToPaste(parsed(shellWords(plainOptionsToPaste(options)))), plainOptionsToPaste(options));
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace gnomon::app
