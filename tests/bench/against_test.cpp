// The alternation of two programs, and the command lines that they receive.
#include "bench/against.h"
#include "bench/child_process.h"
#include "core/error.h"

#include <gtest/gtest.h>

namespace gnomon::bench {
namespace {

TEST(Against, MeasuresInTheOrderAbba) {
    for (const int repetitions : {1, 2, 5}) {
        std::string order;
        std::string firsts;
        double time = 0;
        NoProgress progress;
        const BothSides sides = measureAlternately(
            {"A", {}},
            {"B", {}},
            repetitions,
            [&](const Side& side, bool isFirst) {
                order += side.program;
                if (isFirst) firsts += side.program;
                RunRecord run;
                run.name = "run";
                run.realMs = {{++time}};
                ResultSet set;
                set.runs.push_back(run);
                return set;
            },
            progress);
        EXPECT_EQ(order, std::string("ABBAABBAAB").substr(0, 2 * static_cast<std::size_t>(repetitions)));
        EXPECT_EQ(firsts, "AB");
        const Times& before = sides.before.runs.front().realMs;
        const Times& after = sides.after.runs.front().realMs;
        ASSERT_EQ(before.size(), static_cast<std::size_t>(repetitions));
        ASSERT_EQ(after.size(), before.size());
        for (std::size_t i = 0; i < before.size(); ++i)
            EXPECT_EQ(std::abs(before[i][0] - after[i][0]), 1) << "neighbours in time";
    }
}

TEST(Against, LeavesOutOptionsInBothForms) {
    const RemovedOptions removed{{"--json-file"}, {"--other-machine"}, {"--oracle"}, {"full"}};
    using Words = std::vector<std::string>;
    EXPECT_EQ(
        withoutOptions(
            {"bench", "m.gnm", "--json-file", "a.json", "--size", "8x8", "--json-file=b", "--other-machine"}, removed),
        (Words{"bench", "m.gnm", "--size", "8x8"}));
    EXPECT_EQ(withoutOptions({"--oracle", "full", "m.gnm"}, removed), Words{"m.gnm"});
    EXPECT_EQ(withoutOptions({"--oracle=full", "m.gnm", "--oracle"}, removed), Words{"m.gnm"});
    EXPECT_EQ(withoutOptions({"m.gnm", "--oracle", "--size", "8x8"}, removed), (Words{"m.gnm", "--size", "8x8"}));
}

TEST(ChildProcess, ReturnsOutputAndExitCode) {
    const ChildResult good = runChild({"/bin/sh", "-c", "echo text; exit 3"});
    EXPECT_EQ(good.output, "text\n");
    EXPECT_EQ(good.exitCode, 3);
    EXPECT_GT(good.peakBytes, 0);
    EXPECT_EQ(runChild({"/bin/sh", "-c", "kill -9 $$"}).exitCode, 128 + 9);
    EXPECT_THROW(runChild({"/no/such/program"}), Error);
    EXPECT_EQ(runChild({"/bin/sh", "-c", "head -c 1000000 /dev/zero"}).output.size(), 1000000U);
}

} // namespace
} // namespace gnomon::bench
