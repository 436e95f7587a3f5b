// The sentences of a report against its table: whatever the runs are, nothing is said that a reader could refute.
#include "core/random.h"
#include "report/accuracy_cost.h"
#include "report/page.h"
#include "report/sentences.h"
#include "tests/report/random_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <regex>

namespace gnomon::report {
namespace {

/// The settings but for the number of maps.
std::map<std::string, std::string> otherSettings(const RunSummary& run) {
    std::map<std::string, std::string> settings = run.settings;
    settings.erase("shadow_maps");
    settings.erase("z_partitions");
    return settings;
}

/// The row that a reader looks up for `name`, "four maps" or "exact shadows": like the first run but for the number of
/// maps, and the fastest such.
const RunSummary* rowOf(const std::vector<RunSummary>& table, const std::string& name) {
    const std::vector<std::string> counts = {
        "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"};
    const RunSummary* row = nullptr;
    for (const RunSummary& run : table) {
        if (name == "exact shadows") {
            if (row == nullptr && run.settings.contains("cells") && run.settings.at("cells") == "map+w") row = &run;
            continue;
        }
        const auto count = std::find(counts.begin(), counts.end(), name.substr(0, name.find(' '))) - counts.begin();
        if (run.shadowMaps != count || otherSettings(run) != otherSettings(table.front())) continue;
        if (row == nullptr || run.p50Ms < row->p50Ms) row = &run;
    }
    return row;
}

std::string twoDigits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2g", value);
    return text.data();
}

/// What a table says of two rows: -1 where the first is better by more than noise, or a tenth of an error, 1 where it
/// is worse, 0 where that cannot be told.
int timeVerdict(const RunSummary& a, const RunSummary& b) {
    const double noiseA = a.noise.value_or(0.1);
    const double noiseB = b.noise.value_or(0.1);
    if (a.p50Ms * (1 + noiseA) < b.p50Ms * std::max(1 - noiseB, 0.0)) return -1;
    return b.p50Ms * (1 + noiseB) < a.p50Ms * std::max(1 - noiseA, 0.0) ? 1 : 0;
}

int errorVerdict(double a, double b) {
    return a < 0.9 * b ? -1 : b < 0.9 * a ? 1 : 0;
}

/// The parts of a sentence that compares two rows, by the text alone.
struct Comparison {
    std::string first;
    std::string verdict; // "better", "worse", "time for accuracy", "accuracy for time", "alike"; empty: of times alone
    std::string second;
    std::string firstError;
    std::string secondError;
    std::string time;
};

std::optional<Comparison> parsed(const std::string& sentence) {
    static const std::string errors = ": (.+) (?:instead of|beside) ([0-9.e+-]+|none)%?, and (.+)\\.$";
    static const std::string one = "^(\\w+ (?:maps?|shadows)) ";
    static const std::string two = "(\\w+(?: maps?)?)";
    static const std::regex verdict(one + "(?:is|are) (better|worse) here than " + two + errors);
    static const std::regex trade(one + "trades? (.+) here beside " + two + errors);
    static const std::regex alike(one + "do(?:es)? here what " + two + " do(?:es)?" + errors);
    static const std::regex times(one + "takes? (.+) (?:of|from that of) " + two + "\\.$");
    std::smatch m;
    if (std::regex_match(sentence, m, verdict) || std::regex_match(sentence, m, trade))
        return Comparison{m[1], m[2], m[3], m[4], m[5], m[6]};
    if (std::regex_match(sentence, m, alike)) return Comparison{m[1], "alike", m[2], m[3], m[4], m[5]};
    if (std::regex_match(sentence, m, times)) return Comparison{m[1], "", m[3], "", "", m[2]};
    return std::nullopt;
}

ErrorKind kindOf(const std::string& words) {
    if (words.ends_with("wrong pixels")) return ErrorKind::WrongPixels;
    if (words.ends_with("wrong shadow pixels")) return ErrorKind::WrongShadow;
    return words.starts_with("shadow edges") ? ErrorKind::ShadowEdge : ErrorKind::AliasingBound;
}

bool isShare(ErrorKind kind) {
    return kind == ErrorKind::WrongPixels || kind == ErrorKind::WrongShadow;
}

/// Holds what is said of two times against their rows: every ratio that the noise leaves is in the range that is told,
/// and the range leaves no doubt of who is slower.
void expectTimes(const std::string& words, const RunSummary& a, const RunSummary& b, const std::string& sentence) {
    const int told = timeVerdict(a, b);
    std::smatch m;
    if (words.find("does not tell apart") != std::string::npos) {
        EXPECT_EQ(told, 0) << sentence;
        const double noise = std::max(a.noise.value_or(0.1), b.noise.value_or(0.1));
        EXPECT_NE(words.find("(" + twoDigits(100 * noise) + "%)"), std::string::npos) << sentence;
        return;
    }
    EXPECT_NE(told, 0) << sentence;
    const double lowest = a.p50Ms * std::max(1 - a.noise.value_or(0.1), 0.0) / (b.p50Ms * (1 + b.noise.value_or(0.1)));
    const double highest = a.p50Ms * (1 + a.noise.value_or(0.1)) / (b.p50Ms * std::max(1 - b.noise.value_or(0.1), 0.0));
    static const std::regex range("(at least )?([0-9.e+]+)(?: to ([0-9.e+]+))? times the frame time");
    ASSERT_TRUE(std::regex_match(words, m, range)) << sentence;
    const double low = std::stod(m[2]);
    EXPECT_LE(low, lowest * (1 + 1e-9)) << sentence;
    if (m[1].matched) {
        EXPECT_TRUE(std::isinf(highest)) << sentence;
    } else {
        const double high = m[3].matched ? std::stod(m[3]) : low;
        EXPECT_GE(high, highest * (1 - 1e-9)) << sentence;
        EXPECT_LE(high - highest, 0.1 * high + 0.01) << sentence << " is finer in the table";
        if (told < 0) {
            EXPECT_LE(high, 1) << sentence;
        }
    }
    if (told > 0) {
        EXPECT_GE(low, 1) << sentence;
    }
}

/// Holds a sentence against the rows that it names. Returns whether it compares two.
bool expectTrue(const std::string& sentence, const std::vector<RunSummary>& table) {
    std::string lower = sentence;
    lower[0] = static_cast<char>(std::tolower(lower[0]));
    const auto said = parsed(lower);
    if (!said) return false;
    const RunSummary* a = rowOf(table, said->first);
    const RunSummary* b = rowOf(table, said->second);
    EXPECT_TRUE(a != nullptr && b != nullptr && a != b) << sentence;
    if (a == nullptr || b == nullptr) return true;
    expectTimes(said->time, *a, *b, sentence);
    if (said->verdict.empty()) return true;
    const ErrorKind kind = kindOf(said->firstError);
    EXPECT_TRUE(knows(*a, kind) && knows(*b, kind)) << sentence;
    if (!knows(*a, kind) || !knows(*b, kind)) return true;
    const double scale = isShare(kind) ? 100 : 1;
    const auto figure = [&](const RunSummary& run, const char* none) {
        const double error = scale * run.errors.at(kind);
        return isShare(kind) && error == 0 ? std::string(none) : twoDigits(error);
    };
    EXPECT_NE(said->firstError.find(figure(*a, "no ")), std::string::npos) << sentence;
    EXPECT_EQ(said->secondError, figure(*b, "none")) << sentence;
    const int slower = timeVerdict(*a, *b);
    const int worse = errorVerdict(a->errors.at(kind), b->errors.at(kind));
    const std::string expected = slower * worse < 0   ? worse < 0 ? "time for accuracy" : "accuracy for time"
                                 : slower + worse < 0 ? "better"
                                 : slower + worse > 0 ? "worse"
                                                      : "alike";
    EXPECT_EQ(said->verdict, expected) << sentence;
    return true;
}

/// Holds "Two maps are enough here: ..." against the table. Returns whether that is what `sentence` says.
bool expectSufficient(const std::string& sentence, const std::vector<RunSummary>& table) {
    std::string lower = sentence;
    lower[0] = static_cast<char>(std::tolower(lower[0]));
    std::smatch m;
    static const std::regex form(
        R"(^(\w+ maps?) (?:is|are) enough here: no larger number that was tried lowers the ([\w ]+) by a tenth\.$)");
    if (!std::regex_match(lower, m, form)) return false;
    const RunSummary* here = rowOf(table, m[1]);
    EXPECT_NE(here, nullptr) << sentence;
    const ErrorKind kind = shadowError(table);
    if (here == nullptr || !knows(*here, kind)) return true;
    for (const char* more :
         {"two maps", "three maps", "four maps", "five maps", "six maps", "seven maps", "eight maps"}) {
        const RunSummary* run = rowOf(table, more);
        if (run != nullptr && run->shadowMaps > here->shadowMaps && knows(*run, kind)) {
            EXPECT_GE(run->errors.at(kind), 0.9 * here->errors.at(kind)) << sentence;
        }
    }
    return true;
}

void expectAllTrue(const std::vector<std::string>& told, const std::vector<RunSummary>& table) {
    for (const std::string& sentence : told)
        EXPECT_TRUE(expectTrue(sentence, table) || expectSufficient(sentence, table)) << "no known form: " << sentence;
}

TEST(RandomSentences, SayWhatTheTableSays) {
    Random random(1);
    int said = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const std::vector<RunSummary> runs = anyRuns(random);
        const std::vector<std::string> told = sentences(runs);
        expectAllTrue(told, runs);
        said += told.empty() ? 0 : 1;
    }
    EXPECT_GT(said, 500);
}

TEST(RandomSentences, HangNotOnTheOrderBehindTheFirstRun) {
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        for (std::size_t i = 0; i < runs.size(); ++i)
            runs[i].p50Ms += static_cast<double>(i) / 8; // no two alike
        const std::vector<std::string> told = sentences(runs);
        if (runs.size() > 2) std::reverse(runs.begin() + 1, runs.end());
        EXPECT_EQ(sentences(runs), told);
    }
}

/// The runs of quick reports: plant, clinic, LEGO.
std::vector<std::pair<std::string, std::vector<RunSummary>>> measuredTables() {
    std::ifstream file(GNOMON_MEASURED_RUNS);
    const nlohmann::json document = nlohmann::json::parse(file);
    std::vector<std::pair<std::string, std::vector<RunSummary>>> tables;
    for (const auto& [model, rows] : document.items()) {
        std::vector<RunSummary>& table = tables.emplace_back(model, std::vector<RunSummary>()).second;
        for (const auto& row : rows) {
            RunSummary run;
            run.name = row["name"];
            run.settings = row["settings"].get<std::map<std::string, std::string>>();
            run.shadowMaps = row["shadow_maps"];
            run.p50Ms = row["p50"];
            for (const ErrorKind kind : kErrorKinds)
                if (row["errors"].contains(key(kind))) run.errors[kind] = row["errors"][std::string(key(kind))];
            table.push_back(run);
        }
    }
    return tables;
}

/// The table of a bench whose repetitions are off by up to `noise` each way: three of them, as a report has it.
std::vector<RunSummary> withNoise(std::vector<RunSummary> table, double noise, Random& random) {
    for (RunSummary& run : table) {
        std::array<double, 3> medians{};
        for (double& median : medians)
            median = run.p50Ms * (1 + random.uniform(-noise, noise));
        std::sort(medians.begin(), medians.end());
        run.p50Ms = medians[1];
        run.noise = (medians[2] - medians[0]) / (medians[2] + medians[0]);
    }
    return table;
}

/// How many sentences compare two runs, and how many of them the times without noise refute.
struct Comparisons {
    int compared = 0;
    int refuted = 0;
};

Comparisons comparisonsOf(
    const std::vector<std::string>& told, const std::vector<RunSummary>& runs, const std::vector<RunSummary>& quiet) {
    Comparisons found;
    for (std::string sentence : told) {
        sentence[0] = static_cast<char>(std::tolower(sentence[0]));
        const auto said = parsed(sentence);
        if (!said) continue;
        const RunSummary& a = *rowOf(runs, said->first);
        const RunSummary& b = *rowOf(runs, said->second);
        const double truly = quiet[static_cast<std::size_t>(&a - runs.data())].p50Ms -
                             quiet[static_cast<std::size_t>(&b - runs.data())].p50Ms;
        ++found.compared;
        found.refuted += truly * timeVerdict(a, b) < 0 ? 1 : 0;
    }
    return found;
}

void expectFrontsThatNoiseCanPart(const nlohmann::json& data, const std::vector<RunSummary>& runs) {
    for (const auto& [kind, front] : data["fronts"].items())
        for (std::size_t i = 1; i < front.size(); ++i)
            EXPECT_EQ(timeVerdict(runs[front[i - 1]], runs[front[i]]), -1)
                << "a front through " << kind << " that noise cannot part";
}

/// A table told a hundred times, with fresh noise each time.
void expectTruthUnder(double noise, const std::vector<RunSummary>& quiet, Random& random) {
    Comparisons all;
    for (int trial = 0; trial < 100; ++trial) {
        Report report;
        report.runs = withNoise(quiet, noise, random);
        const nlohmann::json data = pageData(report);
        const auto told = data["sentences"].get<std::vector<std::string>>();
        EXPECT_GE(told.size(), 2U);
        expectAllTrue(told, report.runs);
        const Comparisons found = comparisonsOf(told, report.runs, quiet);
        all.compared += found.compared;
        all.refuted += found.refuted;
        expectFrontsThatNoiseCanPart(data, report.runs);
    }
    EXPECT_GE(all.compared, 100);
    EXPECT_LE(all.refuted, all.compared / 20);
}

TEST(Sentences, OfRealTablesHoldWhateverNoiseTheyHave) {
    Random random(9);
    for (const auto& [model, quiet] : measuredTables()) {
        EXPECT_GE(quiet.size(), 10U) << model;
        for (const double noise : {0.05, 0.5}) {
            SCOPED_TRACE(model + " with noise of " + std::to_string(noise));
            expectTruthUnder(noise, quiet, random);
        }
    }
}

TEST(Sentences, NeverSpeakOfRatiosFinerThanTheNoise) {
    RunSummary one;
    one.shadowMaps = 1;
    one.p50Ms = 100;
    one.noise = 0.5;
    one.errors = {{ErrorKind::WrongShadow, 0.01}};
    RunSummary four = one;
    four.shadowMaps = 4;
    four.p50Ms = 120;
    four.errors = {{ErrorKind::WrongShadow, 0.021}};
    EXPECT_EQ(
        sentences(std::vector{one, four}),
        (std::vector<std::string>{
            "Four maps are worse here than one: 2.1% wrong shadow pixels instead of 1%, and a "
            "frame time that noise (50%) does not tell apart.",
            "One map is enough here: no larger number that was tried lowers the wrong shadow pixels by a tenth."}));
    one.noise = four.noise = 0.01;
    EXPECT_NE(sentences(std::vector{one, four})[0].find("and 1.17 to 1.23 times the frame time."), std::string::npos);
    one.noise = four.noise = std::nullopt; // walked once
    EXPECT_NE(sentences(std::vector{one, four})[0].find("noise (10%) does not tell apart"), std::string::npos);
    four.p50Ms = 400;
    one.noise = 1;
    EXPECT_NE(sentences(std::vector{one, four})[0].find("and at least 1.8 times the frame time."), std::string::npos);
    one.shadowMaps = 8; // the fewest maps of a sweep may be many already
    EXPECT_TRUE(sentences(std::vector{one, four})[0].starts_with("Eight maps "))
        << sentences(std::vector{one, four})[0];
}

TEST(RandomSentences, AreAtMostThreeAndWhole) {
    Random random(5);
    for (int trial = 0; trial < 2000; ++trial) {
        const std::vector<std::string> told = sentences(anyRuns(random));
        EXPECT_LE(told.size(), 3U);
        for (const std::string& sentence : told) {
            EXPECT_TRUE(sentence.ends_with(".")) << sentence;
            EXPECT_EQ(sentence.find("nan"), std::string::npos) << sentence;
            EXPECT_EQ(sentence.find("inf"), std::string::npos) << sentence;
        }
    }
}

} // namespace
} // namespace gnomon::report
