// The sentences of a report against its table. The tests parse the numbers in each sentence and compare them with the
// runs.
#include "core/random.h"
#include "report/accuracy_cost.h"
#include "report/page.h"
#include "report/recommendation.h"
#include "report/sentences.h"
#include "tests/report/random_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
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

const RunSummary* firstWithMaps(const std::vector<RunSummary>& table) {
    for (const RunSummary& run : table)
        if (run.shadowMaps > 0) return &run;
    return nullptr;
}

/// The row that a reader looks up for `name`, "four maps" or "exact shadows": for maps, it is like the first run with
/// maps except for the number of maps, and the fastest such run.
const RunSummary* rowOf(const std::vector<RunSummary>& table, const std::string& name) {
    const std::vector<std::string> counts = {
        "no", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten"};
    const RunSummary* first = firstWithMaps(table);
    const RunSummary* row = nullptr;
    for (const RunSummary& run : table) {
        if (name == "exact shadows") {
            const auto detail = [](const RunSummary& of) {
                return of.settings.contains("error_pixels") ? of.settings.at("error_pixels") : "";
            };
            if (row == nullptr && run.settings.contains("cells") && detail(run) == detail(*first)) row = &run;
            continue;
        }
        const auto count = std::find(counts.begin(), counts.end(), name.substr(0, name.find(' '))) - counts.begin();
        if (run.shadowMaps != count || otherSettings(run) != otherSettings(*first)) continue;
        if (row == nullptr || run.p50Ms < row->p50Ms) row = &run;
    }
    return row;
}

std::string withLowerFirst(std::string sentence) {
    sentence[0] = static_cast<char>(std::tolower(sentence[0]));
    return sentence;
}

/// The content of a sentence that compares two rows, by the text alone. A verdict is -1 if the first row is better.
struct Comparison {
    std::string first;
    std::string second;
    int time = 0;
    std::optional<int> error;
    std::optional<std::pair<double, double>> percents;
    std::pair<double, double> ms;
    double noisePercent = 0;
};

std::optional<Comparison> parsed(const std::string& sentence) {
    static const std::regex form(
        "^(.+?) (?:is|are) (about as fast and as accurate as|about as fast as|(faster|slower)(?: (?:and|but) "
        "(more|less) "
        "accurate)? than|(more|less) accurate than) (\\w+ maps?)(?: at about the same (frame time|accuracy))?: "
        "(?:([0-9.]+)% (?:and|instead of) ([0-9.]+)% wrong pixels, and )?"
        "([0-9.]+) ms (?:and|instead of) ([0-9.]+) ms per frame \\((?:assumed )?noise ([0-9.]+)%\\)\\.$");
    std::smatch m;
    const std::string lower = withLowerFirst(sentence);
    if (!std::regex_match(lower, m, form)) return std::nullopt;
    Comparison said;
    said.first = m[1];
    said.second = m[6];
    said.time = m[3] == "faster" ? -1 : m[3] == "slower" ? 1 : 0;
    const std::string accuracy = m[4].matched ? m[4] : m[5];
    if (m[8].matched) {
        said.error = accuracy == "more" ? -1 : accuracy == "less" ? 1 : 0;
        said.percents = {std::stod(m[8]), std::stod(m[9])};
    }
    EXPECT_EQ(m[7] == "frame time", m[5].matched) << sentence;
    EXPECT_EQ(m[7] == "accuracy", m[3].matched && m[8].matched && !m[4].matched) << sentence;
    EXPECT_EQ(m[2] == "about as fast as", said.time == 0 && !m[8].matched) << sentence;
    said.ms = {std::stod(m[10]), std::stod(m[11])};
    said.noisePercent = std::stod(m[12]);
    return said;
}

double shareOf(const RunSummary& run) {
    return knows(run, ErrorKind::WrongPixels) ? run.errors.at(ErrorKind::WrongPixels) : 0;
}

bool isKnown(const RunSummary& run) {
    return knows(run, ErrorKind::WrongPixels) || run.settings.contains("cells");
}

/// Checks that `shown` is `value` with three digits.
void expectRounded(double shown, double value, const std::string& sentence) {
    EXPECT_NEAR(shown, value, 0.00501 * value + 1e-15) << sentence;
}

/// Checks the numbers of a sentence against the rows that it names, and the verdict against the numbers. Returns false
/// if the sentence has another form.
bool expectTrue(const std::string& sentence, const std::vector<RunSummary>& table) {
    const auto said = parsed(sentence);
    if (!said) return false;
    const RunSummary* a = rowOf(table, said->first);
    const RunSummary* b = rowOf(table, said->second);
    EXPECT_TRUE(a != nullptr && b != nullptr && a != b) << sentence;
    if (a == nullptr || b == nullptr) return true;
    expectRounded(said->ms.first, a->p50Ms, sentence);
    expectRounded(said->ms.second, b->p50Ms, sentence);
    const double noise = 100 * std::max(a->noise.value_or(0.1), b->noise.value_or(0.1));
    EXPECT_GE(said->noisePercent, noise * (1 - 0.005)) << sentence;
    EXPECT_LE(said->noisePercent, noise + 0.1 + 0.005 * noise) << sentence;
    const double slow = 1 + said->noisePercent / 100;
    const double fast = 1 - said->noisePercent / 100;
    const int time = said->ms.first * slow < said->ms.second * fast   ? -1
                     : said->ms.second * slow < said->ms.first * fast ? 1
                                                                      : 0;
    EXPECT_EQ(said->time, time) << sentence;
    EXPECT_EQ(said->percents.has_value(), isKnown(*a) && isKnown(*b)) << sentence;
    if (!said->percents) return true;
    const auto [percentA, percentB] = *said->percents;
    expectRounded(percentA, 100 * shareOf(*a), sentence);
    expectRounded(percentB, 100 * shareOf(*b), sentence);
    EXPECT_EQ(said->error, percentA < 0.9 * percentB ? -1 : percentB < 0.9 * percentA ? 1 : 0) << sentence;
    return true;
}

/// Checks "Two maps suffice here ..." against the table. Returns false if the sentence has another form.
bool expectSufficient(const std::string& sentence, const std::vector<RunSummary>& table) {
    const std::string lower = withLowerFirst(sentence);
    std::smatch m;
    static const std::regex form("^(\\w+ maps?) suffices? here \\(([0-9.]+)% wrong pixels\\): no larger number of maps "
                                 "in this bench lowers this "
                                 "share by more than a tenth\\.$");
    if (!std::regex_match(lower, m, form)) return false;
    const RunSummary* here = rowOf(table, m[1]);
    EXPECT_NE(here, nullptr) << sentence;
    if (here == nullptr) return true;
    expectRounded(std::stod(m[2]), 100 * shareOf(*here), sentence);
    for (const char* more :
         {"two maps", "three maps", "four maps", "five maps", "six maps", "seven maps", "eight maps"}) {
        const RunSummary* run = rowOf(table, more);
        if (run != nullptr && run->shadowMaps > here->shadowMaps) {
            EXPECT_TRUE(isKnown(*run)) << sentence;
            EXPECT_GE(shareOf(*run), 0.9 * 0.99 * shareOf(*here)) << sentence;
        }
    }
    if (const auto choice = recommend(table); choice && otherSettings(table[*choice]) == otherSettings(*here)) {
        EXPECT_LE(table[*choice].shadowMaps, here->shadowMaps) << sentence << " but more are recommended";
    }
    return true;
}

void expectAllTrue(const std::vector<std::string>& told, const std::vector<RunSummary>& table) {
    for (const std::string& sentence : told)
        EXPECT_TRUE(expectTrue(sentence, table) || expectSufficient(sentence, table)) << "no known form: " << sentence;
}

/// Returns `runs` with long numbers, so that rounding matters.
std::vector<RunSummary> withLongNumbers(std::vector<RunSummary> runs, Random& random) {
    const double range = random.below(2) == 0 ? 0.001 : 0.2;
    for (RunSummary& run : runs) {
        run.p50Ms *= random.uniform(1 - range, 1 + range);
        for (auto& [kind, error] : run.errors)
            error *= 0.05 * random.uniform(1 - range, 1 + range);
    }
    return runs;
}

TEST(RandomSentences, SayWhatTheTableSays) {
    Random random(1);
    std::map<std::string, int> verdicts;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        if (trial % 2 == 1) runs = withLongNumbers(runs, random);
        if (trial % 7 == 0) // without a ground truth
            for (RunSummary& run : runs)
                run.errors.erase(ErrorKind::WrongPixels);
        const std::vector<std::string> told = sentences(runs);
        expectAllTrue(told, runs);
        for (const std::string& sentence : told)
            if (const auto said = parsed(sentence))
                ++verdicts[std::to_string(said->time) + (said->error ? std::to_string(*said->error) : "")];
            else
                ++verdicts["suffice"];
    }
    EXPECT_EQ(verdicts.size(), 13U) << "each verdict is said: 9 with accuracy, 3 without, and the sufficient number";
}

TEST(RandomSentences, DoNotDependOnTheOrderAfterTheFirstRunWithMaps) {
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<RunSummary> runs = anyRuns(random);
        if (runs.empty() || runs[0].shadowMaps < 1) continue;
        std::size_t exact = 0;
        for (std::size_t i = 0; i < runs.size(); ++i) {
            runs[i].p50Ms += static_cast<double>(i) / 8;                          // no two alike
            if (isExact(runs[i]) && exact++ > 0) runs[i].settings.erase("cells"); // the first of several is named
        }
        const std::vector<std::string> told = sentences(runs);
        std::reverse(runs.begin() + 1, runs.end());
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
    for (const std::string& sentence : told) {
        const auto said = parsed(sentence);
        if (!said) continue;
        const RunSummary& a = *rowOf(runs, said->first);
        const RunSummary& b = *rowOf(runs, said->second);
        const double truly = quiet[static_cast<std::size_t>(&a - runs.data())].p50Ms -
                             quiet[static_cast<std::size_t>(&b - runs.data())].p50Ms;
        ++found.compared;
        found.refuted += truly * said->time < 0 ? 1 : 0;
    }
    return found;
}

void expectFrontsThatNoiseCanPart(const nlohmann::json& data, const std::vector<RunSummary>& runs) {
    for (const auto& [kind, front] : data["fronts"].items())
        for (std::size_t i = 1; i < front.size(); ++i)
            EXPECT_EQ(compareTimes(runs[front[i - 1]], runs[front[i]]), TimeOrder::Less)
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

TEST(Sentences, CiteTheNumbersOfTheirVerdict) {
    RunSummary one;
    one.shadowMaps = 1;
    one.p50Ms = 100;
    one.noise = 0.5;
    one.errors = {{ErrorKind::WrongPixels, 0.01}};
    RunSummary four = one;
    four.shadowMaps = 4;
    four.p50Ms = 120;
    four.errors = {{ErrorKind::WrongPixels, 0.021}};
    EXPECT_EQ(
        sentences(std::vector{one, four}),
        (std::vector<std::string>{
            "Four maps are less accurate than one map at about the same frame time: 2.1% instead of 1% wrong pixels, "
            "and "
            "120 ms and 100 ms per frame (noise 50%).",
            "One map suffices here (1% wrong pixels): no larger number of maps in this bench lowers this share by more "
            "than a tenth."}));
    one.noise = four.noise = 0.01;
    EXPECT_NE(
        sentences(std::vector{one, four})[0].find("120 ms instead of 100 ms per frame (noise 1%)"), std::string::npos);
    one.noise = four.noise = std::nullopt; // walked once
    EXPECT_NE(sentences(std::vector{one, four})[0].find("(assumed noise 10%)"), std::string::npos);
    RunSummary exact = one;
    exact.shadowMaps = 0;
    exact.settings = {{"cells", "map+w"}};
    exact.errors.clear();
    exact.p50Ms = 30.7;
    exact.noise = four.noise = 0.05;
    EXPECT_EQ(
        sentences(std::vector{exact, four}),
        (std::vector<std::string>{"Exact shadows are faster and more accurate than four maps: 0% instead of 2.1% wrong "
                                  "pixels, and 30.7 ms instead of 120 ms per frame (noise 5%)."}));
    EXPECT_TRUE(sentences(std::vector<RunSummary>{}).empty());
    EXPECT_TRUE(sentences(std::vector{one}).empty());
}

// More maps are recommended for their last tenth of accuracy, so no sentence may say that fewer suffice.
TEST(Sentences, DoNotCallFewMapsSufficientIfMoreAreRecommended) {
    RunSummary four;
    four.shadowMaps = 4;
    four.p50Ms = 40;
    four.errors = {{ErrorKind::WrongPixels, 0.000412}};
    RunSummary six = four;
    six.shadowMaps = 6;
    six.p50Ms = 41;
    six.errors = {{ErrorKind::WrongPixels, 0.0004}};
    ASSERT_EQ(recommend(std::vector{four, six}), 1U);
    EXPECT_EQ(sentences(std::vector{four, six}).size(), 1U);
    six.p50Ms = 90;
    EXPECT_EQ(sentences(std::vector{four, six}).size(), 2U);
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
