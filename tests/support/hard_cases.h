// The hard cases of a layer as a table: a name, the failure of a naive implementation, and a check. docs/hard_cases.md
// shows the same tables. A test fails if the two differ, and rewrites the section of the page if GNOMON_WRITE_DOCS is
// set.
#pragma once

#include "core/file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <span>
#include <string>

namespace gnomon {

/// One hard case. `check` uses the EXPECT macros.
struct HardCase {
    const char* name;
    const char* breaks;
    void (*check)();
};

/// Returns the Markdown section `title` of docs/hard_cases.md for `cases`.
inline std::string hardCaseSection(const std::string& title, std::span<const HardCase> cases) {
    std::string text = "## " + title + "\n\n| case | what breaks there if done naively |\n|---|---|\n";
    for (const HardCase& row : cases)
        text += std::string("| ") + row.name + " | " + row.breaks + " |\n";
    return text;
}

/// Runs all cases, and checks that the page below `sourceDir` contains the table.
inline void runHardCases(const std::string& sourceDir, const std::string& title, std::span<const HardCase> cases) {
    for (const HardCase& row : cases) {
        SCOPED_TRACE(row.name);
        row.check();
    }
    const std::string path = sourceDir + "/docs/hard_cases.md";
    std::string page = readTextFile(path);
    const std::string wanted = hardCaseSection(title, cases);
    if (std::getenv("GNOMON_WRITE_DOCS") != nullptr) {
        const std::size_t begin = page.find("## " + title + "\n");
        const std::size_t next = begin == std::string::npos ? begin : page.find("\n## ", begin);
        const std::string rest = next == std::string::npos ? "" : page.substr(next);
        page = (begin == std::string::npos ? page + "\n" : page.substr(0, begin)) + wanted + rest;
        writeTextFile(path, page);
    }
    EXPECT_NE(page.find(wanted), std::string::npos)
        << path << " differs from the table: run this test once with GNOMON_WRITE_DOCS=1";
}

} // namespace gnomon
