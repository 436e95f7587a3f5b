// The view and quality options as a command line takes them and a report prints them.
#include "app/command_line.h"
#include "core/file.h"
#include "gl/shader_library.h"
#include "settings/table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

namespace gnomon::app {
namespace {

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

TEST(CommandLine, WhatIsPastedIsWhatWasGiven) {
    EXPECT_EQ(settings::optionsToPaste(settings::Settings(), false), "");
    const std::string folder = testing::TempDir() + "it's a folder";
    for (const auto& [path, text] : gl::kEmbeddedShaders) {
        const std::filesystem::path shader = std::filesystem::path(folder) / path;
        std::filesystem::create_directories(shader.parent_path());
        writeTextFile(shader.string(), std::string(text));
    }
    // clang-format off
    const std::vector<std::string> given = {
        "--size", "64x48", "--shadow-near", "0.5", "--shadow-far", "90", "--near-floor", "0.01", "--light", "-1,2,0.5",
        "--max-triangles", "10k", "--eta", "-0.25", "--split-lambda", "0.5", "--max-aliasing", "2", "--backend",
        "software", "--memory", "512M", "--gpu-memory", "2G", "--shaders", folder};
    // clang-format on
    const auto parsed = [](std::vector<std::string> words) {
        CLI::App command;
        SettingOptions options;
        options.addTo(command);
        std::reverse(words.begin(), words.end()); // as CLI11 takes a vector
        command.parse(words);
        return options.settings();
    };
    const settings::Settings settings = parsed(given);
    const std::string pasted = settings::optionsToPaste(settings, false);
    EXPECT_EQ(shellWords(pasted), given);
    EXPECT_EQ(settings::optionsToPaste(parsed(shellWords(pasted)), false), pasted);
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace gnomon::app
