#include "app/command_bench_build.h"

#include "app/bench_against.h"
#include "app/commands.h"
#include "app/console.h"
#include "bench/child_process.h"
#include "bench/verdict_text.h"
#include "core/error.h"
#include "core/file.h"
#include "core/formatted.h"
#include "core/random.h"
#include "settings/usage_error.h"
#include "telemetry/benchmark_report.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <thread>

#include <nlohmann/json.hpp>

namespace gnomon::app {

namespace {

/// An option that `gnomon build` receives.
struct PassedOption {
    const char* name;
    const char* value;
    const char* help;
};

constexpr std::array kPassed{
    PassedOption{"--memory", "SIZE", "Max resident memory of the build"},
    PassedOption{"--error", "KIND", "Stored errors: measured, tight or estimated"},
    PassedOption{"--simplifier", "NAME", "Simplifier: quadric, meshopt or openmesh"},
    PassedOption{"--cluster-triangles", "N", "Max triangles per cluster"},
    PassedOption{"--chunk-triangles", "COUNT", "Max triangles per chunk"},
    PassedOption{"--textures", "MODE", "Textures: bake or off"},
    PassedOption{"--up", "AXIS", "Up direction"}};

struct BenchBuildOptions {
    CommonOptions common;
    GateOptions gates;
    std::vector<std::string> sources;
    std::array<std::string, kPassed.size()> passed;
    std::string temporary;
    std::optional<int> repetitions;
};

/// Returns a hash of the bytes of all `paths`.
std::string sourceHash(const std::vector<std::string>& paths) {
    std::uint64_t hash = 0;
    std::vector<std::byte> block(std::size_t{1} << 20U);
    for (const std::string& path : paths) {
        File file(path, File::Mode::Read);
        while (const std::size_t size = file.readSome(block)) {
            std::fill(block.begin() + static_cast<std::ptrdiff_t>(size), block.end(), std::byte{0});
            for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
                std::uint64_t word = 0;
                std::memcpy(&word, &block[i], sizeof word);
                hash = mix64(hash ^ word);
            }
            hash = mix64(hash ^ size);
        }
    }
    return formatted("%016llx", static_cast<unsigned long long>(hash));
}

std::string passedValue(const BenchBuildOptions& options, const std::string& name, const std::string& otherwise) {
    for (std::size_t i = 0; i < kPassed.size(); ++i)
        if (name == kPassed[i].name && !options.passed[i].empty()) return options.passed[i];
    return otherwise;
}

std::map<std::string, std::string> contextOf(const BenchBuildOptions& options) {
    std::map<std::string, std::string> context = telemetry::machineContext();
    context.erase("host_name");
    context["source_hash"] = sourceHash(options.sources);
    context["version"] = GNOMON_VERSION;
    const unsigned cores = std::thread::hardware_concurrency();
    context["threads"] = std::to_string(options.common.threads > 0 ? options.common.threads : static_cast<int>(cores));
    std::string given;
    for (std::size_t i = 0; i < kPassed.size(); ++i)
        if (!options.passed[i].empty())
            given += std::string(given.empty() ? "" : ", ") + kPassed[i].name + " " + options.passed[i];
    context["options"] = given.empty() ? "none" : given;
    return context;
}

double numberIn(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

/// Returns the JSON document that `words` print. Throws Error if the program fails or prints something else.
nlohmann::json documentOf(const std::vector<std::string>& words, bench::ChildResult& child) {
    child = bench::runChild(words);
    if (child.exitCode != 0)
        throw Error(words.front(), "its " + words[1] + " failed", "exit code 0", std::to_string(child.exitCode));
    nlohmann::json document = nlohmann::json::parse(child.output, nullptr, false);
    if (!document.is_object()) throw Error(words.front(), "its " + words[1] + " printed no JSON document");
    return document;
}

/// Returns the tightness of the stored errors of `model`, or nullopt if it is not known.
std::optional<double> tightnessOf(
    const std::string& program, const std::string& model, const std::vector<std::string>& sources) {
    std::vector<std::string> words{program, "verify", model, "--json", "--progress", "none", "--cuts", "1", "--source"};
    words.insert(words.end(), sources.begin(), sources.end());
    bench::ChildResult child;
    const nlohmann::json document = documentOf(words, child);
    if (!document.contains("checks") || !document["checks"].is_array()) return std::nullopt;
    for (const nlohmann::json& check : document["checks"])
        if (check.is_object() && check.value("name", "") == "error_bound" && check.contains("tightness") &&
            check["tightness"].is_number())
            return check["tightness"].get<double>();
    return std::nullopt;
}

/// Builds the model once by the program of `side` and returns its figures.
bench::ResultSet buildOnce(const BenchBuildOptions& options, const bench::Side& side, bool isFirst) {
    const ScratchFolder folder(
        options.temporary.empty() ? std::filesystem::temp_directory_path().string() : options.temporary);
    const std::string model = folder.file("model.gnm");
    std::vector<std::string> words{side.program, "build"};
    words.insert(words.end(), options.sources.begin(), options.sources.end());
    words.insert(words.end(), {"-o", model, "--json", "--progress", "none"});
    words.insert(words.end(), side.words.begin(), side.words.end());
    bench::ChildResult child;
    const nlohmann::json report = documentOf(words, child);
    bench::ResultSet set;
    set.path = side.program;
    set.context = contextOf(options);
    bench::RunRecord& run = set.runs.emplace_back();
    const double triangles = numberIn(report, "source_triangles");
    run.name = std::filesystem::path(options.sources.front()).stem().string() + "/build/" +
               passedValue(options, "--simplifier", "quadric") + "/" + formatted("%.0f", triangles) + "/" +
               passedValue(options, "--error", "measured") + "/cpu";
    run.label = "build";
    run.realMs = {{1e3 * numberIn(report, "seconds")}};
    run.cpuMs = {{1e3 * child.cpuSeconds}};
    run.process[bench::kPeakMemory] = {numberIn(report, "peak_rss_bytes")};
    run.work["temporary_bytes"] = numberIn(report, "temporary_bytes");
    run.work["file_bytes"] = numberIn(report, "file_bytes");
    run.facts["triangles_per_second"] = numberIn(report, "triangles_per_second");
    if (isFirst)
        if (const auto tightness = tightnessOf(side.program, model, options.sources))
            run.errors["tightness"] = *tightness;
    return set;
}

std::string tableText(const bench::RunRecord& run) {
    const auto value = [](const std::map<std::string, double>& values, const char* key) {
        const auto found = values.find(key);
        return found == values.end() ? 0 : found->second;
    };
    std::vector<double> peaks = run.process.at(bench::kPeakMemory);
    return run.name +
           formatted(
               ": %.4g s, %.4g processor s, %.4g M triangles/s, peak %.4g MiB, temporary %.4g MiB, file %.4g MiB, "
               "tightness %.4g\n",
               bench::medianOf(run.realMs) / 1e3,
               bench::medianOf(run.cpuMs) / 1e3,
               value(run.facts, "triangles_per_second") / 1e6,
               telemetry::quantile(peaks, 0.5) * 0x1p-20,
               value(run.work, "temporary_bytes") * 0x1p-20,
               value(run.work, "file_bytes") * 0x1p-20,
               value(run.errors, "tightness"));
}

void run(const BenchBuildOptions& options) {
    bench::Limits limits = limitsOf(options.gates);
    limits.alikeKeys = {"source_hash", "options", "threads"};
    const bool isAgainst = !options.gates.against.empty();
    const std::optional<bench::ResultSet> baseline = baselineOf(options.gates);
    bench::Side now{bench::ownProgram(), {}};
    for (std::size_t i = 0; i < kPassed.size(); ++i)
        if (!options.passed[i].empty()) now.words.insert(now.words.end(), {kPassed[i].name, options.passed[i]});
    if (options.common.threads > 0)
        now.words.insert(now.words.end(), {"--threads", std::to_string(options.common.threads)});
    GateFiles files(options.gates);
    const int repetitions = options.repetitions.value_or(isAgainst ? kRepetitionsAgainst : 3);
    const bench::MeasureOnce measure = [&](const bench::Side& side, bool isFirst) {
        return buildOnce(options, side, isFirst);
    };
    const auto progress = makeProgress(options.common);
    progress->stage("bench", "builds", static_cast<std::uint64_t>(isAgainst ? 2 * repetitions : repetitions));
    const bool isSilent = options.gates.writesJsonToStdout();
    if (isAgainst) {
        limits.pairing = bench::Pairing::Repetitions;
        const bench::Side before{std::filesystem::absolute(options.gates.against).string(), now.words};
        return compareSides(before, now, {repetitions, measure, limits, isSilent}, files, *progress);
    }
    bench::ResultSet set;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
        bench::ResultSet once = measure(now, repetition == 0);
        progress->advance(1);
        if (repetition == 0)
            set = std::move(once);
        else
            bench::append(set, once);
    }
    const bench::Verdict verdict = baseline ? verdictOf(*baseline, set, limits) : bench::Verdict();
    files.write(set, baseline ? &verdict : nullptr);
    if (!isSilent) std::fputs((tableText(set.runs.front()) + bench::verdictText(verdict)).c_str(), stdout);
    requirePrinted();
    if (baseline) conclude(verdict, baseline->path);
}

} // namespace

CLI::App* addBenchBuildCommand(CLI::App& bench) {
    auto options = std::make_shared<BenchBuildOptions>();
    CLI::App* command =
        bench.add_subcommand("build", "Measure the build of a model: time, memory, bytes and tightness");
    command->add_option("SOURCE", options->sources, "Meshes to build, as gnomon build reads them")->required();
    command->add_option("--repetitions", options->repetitions, "Number of builds")
        ->check(CLI::Range(1, 1000000))
        ->type_name("R")
        ->default_str("3, or 9 with --against");
    command->add_option("--tmp", options->temporary, "Folder for the model and for temporary files")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
    for (std::size_t i = 0; i < kPassed.size(); ++i)
        command->add_option(kPassed[i].name, options->passed[i], kPassed[i].help)->type_name(kPassed[i].value);
    addGateOptions(*command, options->gates);
    addCommonOptions(*command, options->common);
    command->callback([options] { run(*options); });
    return command;
}

} // namespace gnomon::app
