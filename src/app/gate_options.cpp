#include "app/gate_options.h"

#include "app/program.h"
#include "bench/alike_keys.h"
#include "bench/result_formats.h"
#include "bench/result_json.h"
#include "bench/verdict_text.h"
#include "settings/codec.h"
#include "settings/usage_error.h"

#include <cstdio>
#include <sstream>

namespace gnomon::app {

namespace {

constexpr const char* kCounters = "triangles, fragments, sample_tests, bytes_read, pages, temporary_bytes, file_bytes";

settings::Codec<double> percentage() {
    return settings::number("a number of at least 0", [](double value) { return value >= 0; });
}

bool isCounter(const std::string& name) {
    std::istringstream names(kCounters);
    for (std::string each; std::getline(names >> std::ws, each, ',');)
        if (each == name) return true;
    return false;
}

/// Parses "PERCENT[,COUNTER=PERCENT...]" into `limits`.
void setWorkLimits(const std::string& text, bench::Limits& limits) {
    std::istringstream parts(text);
    bool isFirst = true;
    for (std::string part; std::getline(parts, part, ',');) {
        const std::size_t equals = part.find('=');
        const std::string counter = part.substr(0, equals);
        if (equals == std::string::npos && isFirst)
            limits.workAbovePercent = settings::parsed(percentage(), "--work-above", part);
        else if (equals == std::string::npos || !isCounter(counter))
            throw settings::UsageError{
                "--work-above",
                "--work-above: expected PERCENT[,COUNTER=PERCENT...] with the counters " + std::string(kCounters) +
                    ", found '" + part + "'"};
        else
            limits.workAbove[counter] = settings::parsed(percentage(), "--work-above", part.substr(equals + 1));
        isFirst = false;
    }
}

} // namespace

void addGateOptions(CLI::App& command, GateOptions& options) {
    const auto add = [&](const char* name, std::string& value, const char* help, const char* type) {
        return command.add_option(name, value, help)->type_name(type);
    };
    add("--json-file", options.json, "Write the runs in the format of Google Benchmark; - is stdout", "FILE.json");
    add("--baseline", options.baseline, "Compare with the --json-file of an earlier bench", "FILE.json");
    add("--against", options.against, "Compare with another gnomon; both programs run alternately", "OLD_GNOMON");
    add("--fail-above", options.failAbove, "Max growth of times and memory, in percent", "PERCENT")->default_str("10");
    add("--work-above", options.workAbove, "Max growth of work counters, in percent", "PERCENT[,COUNTER=PERCENT...]")
        ->default_str("0");
    add("--undecided", options.undecided, "Result of a time gate that noise leaves undecided", "RESULT")
        ->check(CLI::IsMember({"pass", "fail"}))
        ->default_str("pass");
    command.add_flag("--other-machine", options.allowsOtherMachine, "Allow a baseline of another processor");
    add("--verdict", options.verdict, "Write all gates with their figures", "FILE.json");
    add("--summary-md", options.summaryMd, "Write a summary in Markdown", "FILE.md");
    add("--bmf", options.bmf, "Write Bencher's metric format", "FILE.json");
    add("--action-json", options.actionJson, "Write the custom JSON of github-action-benchmark", "FILE.json");
}

std::vector<std::string> optionsWithValue() {
    return {
        "--json-file",
        "--baseline",
        "--against",
        "--fail-above",
        "--work-above",
        "--undecided",
        "--verdict",
        "--summary-md",
        "--bmf",
        "--action-json"};
}

std::vector<std::string> flags() {
    return {"--other-machine"};
}

bench::Limits limitsOf(const GateOptions& options) {
    if (!options.baseline.empty() && !options.against.empty())
        throw settings::UsageError{"--against", "--baseline and --against contradict each other: give one of them"};
    if (options.baseline.empty() && options.against.empty())
        for (const auto& [name, isGiven] :
             {std::pair{"--fail-above", !options.failAbove.empty()},
              std::pair{"--work-above", !options.workAbove.empty()},
              std::pair{"--undecided", !options.undecided.empty()},
              std::pair{"--other-machine", options.allowsOtherMachine}})
            if (isGiven)
                throw settings::UsageError{
                    name, std::string(name) + " needs --baseline or --against, because it limits a comparison"};
    bench::Limits limits;
    if (!options.failAbove.empty())
        limits.failAbovePercent = settings::parsed(percentage(), "--fail-above", options.failAbove);
    if (!options.workAbove.empty()) setWorkLimits(options.workAbove, limits);
    if (options.undecided == "fail") limits.undecided = bench::Decision::Fail;
    limits.allowsOtherMachine = options.allowsOtherMachine;
    return limits;
}

std::optional<bench::ResultSet> baselineOf(const GateOptions& options) {
    if (options.baseline.empty()) return std::nullopt;
    bench::ResultSet baseline = bench::readResultSet(options.baseline);
    bench::refuseRemovedWords(baseline);
    return baseline;
}

GateFiles::GateFiles(const GateOptions& options)
    : isPrinted_(options.writesJsonToStdout()),
      json_(isPrinted_ ? "" : options.json),
      verdict_(options.verdict),
      summaryMd_(options.summaryMd),
      bmf_(options.bmf),
      actionJson_(options.actionJson) {}

void GateFiles::write(const bench::ResultSet& set, const bench::Verdict* verdict) {
    json_.write(bench::resultJson(set));
    if (isPrinted_) std::fputs(bench::resultJson(set).c_str(), stdout);
    summaryMd_.write(bench::summaryMarkdown(set, verdict));
    bmf_.write(bench::bmfJson(set));
    actionJson_.write(bench::actionJson(set));
    writeVerdict(verdict == nullptr ? bench::Verdict() : *verdict);
}

void GateFiles::writeVerdict(const bench::Verdict& verdict) {
    verdict_.write(bench::verdictJson(verdict));
}

void conclude(const bench::Verdict& verdict, const std::string& against) {
    if (verdict.exitCode() == 0) return;
    throw GatesFailed(verdict.exitCode(), against + ": " + bench::failureLine(verdict));
}

} // namespace gnomon::app
