#include "core/error.h"
#include "core/file.h"
#include "preprocess/pipeline/fingerprint.h"
#include "tests/pipeline/test_folder.h"

#include <gtest/gtest.h>

#include <chrono>

namespace gnomon::pipeline {
namespace {

TEST(Fingerprint, TellsPeopleWhatAnInputIs) {
    const TestFolder folder;
    const std::vector<std::string> inputs{folder.file("a"), folder.file("b")};
    for (const std::string& input : inputs) {
        writeTextFile(input, "a mesh");
        const auto when = std::chrono::sys_days(std::chrono::year(2001) / 9 / 9) + std::chrono::milliseconds(6'400'025);
        std::filesystem::last_write_time(input, std::chrono::file_clock::from_sys(when));
    }
    const std::string text = fingerprintOf(inputs);
    EXPECT_EQ(text.find("input 1 bytes 6, input 1 changed 2001-09-09T01:46:40.025000000Z, input 1 samples "), 0U);
    EXPECT_NE(text.find(", input 2 bytes 6, input 2 changed 2001-09-09T01:46:40.025"), std::string::npos) << text;
    EXPECT_THROW(fingerprintOf({"/dev/null"}), Error);
}

} // namespace
} // namespace gnomon::pipeline
