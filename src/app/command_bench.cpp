#include "app/bench_against.h"
#include "app/command_bench_build.h"
#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/oracle_option.h"
#include "app/thread_limit.h"
#include "bench/alike_keys.h"
#include "bench/bench_output.h"
#include "bench/bench_text.h"
#include "bench/child_process.h"
#include "bench/report_runs.h"
#include "bench/results_of_runs.h"
#include "bench/summarize.h"
#include "bench/verdict_text.h"
#include "core/formatted.h"
#include "core/prepared_output.h"
#include "manual/command_words.h"
#include "settings/codec.h"
#include "settings/contradictions.h"
#include "settings/files/named_files.h"
#include "settings/old_names.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "telemetry/benchmark_report.h"
#include "telemetry/shortfall.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>
#include <set>

namespace gnomon::app {

namespace {

struct BenchOptions {
    CommonOptions common;
    SettingOptions settings;
    bench::WalkOptions walk;
    std::string model;
    std::string path;
    std::optional<std::string> shadowMaps;
    std::string csv;
    GateOptions gates;
    std::string againstModel;
    std::string images;
    bool hasAllImages = false;
    std::string report;
    std::optional<int> repetitions;
    bool isQuick = false;
    std::string budgetMs;
    std::string maxWrongPixels;
};

/// Returns how `gnomon bench` moves along its camera path. --quick reduces the number of frames. With --report, the
/// defaults are several repetitions and a validation.
bench::WalkOptions walkOf(const BenchOptions& options) {
    bench::WalkOptions walk = options.walk;
    if (options.isQuick) {
        walk.frames = std::min(walk.frames, 8);
        walk.warmup = 1;
    }
    walk.repetitions = options.repetitions.value_or(options.report.empty() ? 1 : 3);
    const bool isProven = walk.groundTruth != validation::GroundTruth::None;
    if (walk.isRealTime && isProven)
        throw settings::UsageError{
            "--oracle",
            "--oracle and --no-wait contradict each other: a frame that is compared with rays waits for its pages"};
    walk.provenFrames = walk.frames;
    walk.countsWrongPixels = isProven;
    const bool isAsked = !options.budgetMs.empty() || !options.maxWrongPixels.empty();
    if ((!options.report.empty() || isAsked) && !isProven && !walk.isRealTime) {
        walk.groundTruth = validation::GroundTruth::SameDetail;
        walk.countsWrongPixels = true;
        walk.provenFrames = options.isQuick || options.report.empty() ? 3 : 8;
    }
    return walk;
}

/// The limits that a bench must not exceed: those of the gates, --budget-ms (ms) and --max-wrong-pixels (a share).
struct Bounds {
    bench::Limits gates;
    std::optional<double> budgetMs;
    std::optional<double> maxWrongShare;
};

/// Parses the limits of --fail-above and --budget-ms. Throws UsageError for a negative percentage, or for a budget of 0
/// or less.
Bounds boundsOf(const BenchOptions& options) {
    Bounds bounds{limitsOf(options.gates), std::nullopt, std::nullopt};
    bounds.gates.waits = !options.walk.isRealTime;
    if (!options.budgetMs.empty())
        bounds.budgetMs = settings::parsed(settings::positiveNumber(), "--budget-ms", options.budgetMs);
    const auto percentage =
        settings::number("a percentage from 0 to 100", [](double value) { return value >= 0 && value <= 100; });
    if (!options.maxWrongPixels.empty())
        bounds.maxWrongShare = settings::parsed(percentage, "--max-wrong-pixels", options.maxWrongPixels) / 100;
    return bounds;
}

/// Returns the given options that a bench can sweep, with their values: "error_pixels:1, filter:3". Options with
/// several values are left out, because the names of the runs contain them.
std::string givenText(const std::vector<settings::Axis>& axes) {
    std::string text;
    for (const settings::Axis& axis : axes) {
        if (axis.values.size() != 1) continue;
        settings::Settings with;
        axis.setting->set(with, axis.values.front());
        text += (text.empty() ? "" : ", ") + axis.setting->column() + ":" + axis.setting->text(with);
    }
    return text.empty() ? "none" : text;
}

/// Returns the runs of a bench, one per combination of settings. Throws UsageError if options contradict each other in
/// one of the runs.
std::vector<bench::BenchRun> runsOf(const BenchOptions& options) {
    settings::Settings fixed = options.settings.fixedSettings();
    if (options.shadowMaps || validation::isOfMaps(options.walk.groundTruth)) settings::askForMaps(fixed);
    if (validation::isOfMaps(options.walk.groundTruth) && !options.report.empty())
        settings::requireDirectionalLight(fixed, "--report");
    requireNoWindow(fixed);
    settings::Request request{options.model, fixed, {}};
    request.output.path = options.path;
    settings::requireSound(request);
    const std::vector<settings::Axis> axes = options.settings.axes(options.shadowMaps);
    std::set<std::string> given;
    for (const settings::Axis& axis : axes)
        given.insert(axis.setting->column());
    std::vector<bench::BenchRun> runs = bench::runsOf(settings::combinations(fixed, axes), given);
    if (runs.size() == 1 && !options.report.empty()) runs = bench::reportRuns(runs.front().settings, options.isQuick);
    for (const bench::BenchRun& run : runs)
        settings::requireSound(run.settings); // before the first run, because runs take long
    return runs;
}

/// Returns the backend that draws all `runs`.
settings::Backend backendOf(const std::vector<bench::BenchRun>& runs) {
    return task::backendFor(bench::backendSettings(runs), settings::DrawingCommand::Bench).backend;
}

/// A bench that is ready to run. The constructor reports all errors that can be known without drawing a frame.
class Bench {
public:
    explicit Bench(const BenchOptions& options)
        : options_(options),
          bounds_(boundsOf(options)),
          runs_(runsOf(options)),
          path_(path::projected(path::readCameraPath(options.path), runs_.front().settings.projection)),
          baseline_(baselineOf(options.gates)),
          session_(options.model, bench::backendSettings(runs_), printWarning, backendOf(runs_)),
          csv_(options.csv),
          files_(options.gates),
          images_(options.images),
          report_(options.report) {
        if (options.isQuick) shorten();
        context_ = bench::statedFacts(runs_, path_, options_.walk, session_);
        context_["path"] = std::filesystem::path(options.path).filename().string();
        context_["version"] = GNOMON_VERSION;
        context_["threads"] = std::to_string(ThreadLimit::current());
        context_["options"] = givenText(options.settings.axes(options.shadowMaps));
        if (baseline_) requireComparable();
        if (options.hasAllImages)
            options_.walk.onPicture = [folder = options.images](auto run, int frame, auto png) {
                bench::writeFramePicture(folder, run, frame, png);
            };
    }

    void run() {
        const double stolen = telemetry::stolenSeconds();
        const std::vector<bench::RunResult> results = walked();
        std::vector<report::RunSummary> summaries;
        std::transform(results.begin(), results.end(), std::back_inserter(summaries), bench::summarize);
        context_["first_frame_ms"] = std::to_string(results.front().firstFrameMs);
        context_["steal_seconds"] = formatted("%.2f", telemetry::stolenSeconds() - stolen);
        tellShortfall(results);
        csv_.write(bench::csvText(results)); // first, because a later step can be interrupted
        const bench::ResultSet set = bench::resultSet(context_, results, options_.walk.isRealTime);
        bench::Verdict verdict;
        if (baseline_) verdict = bench::judge(*baseline_, set, bounds_.gates);
        const std::string choices = choicesText(summaries, verdict);
        files_.write(set, hasGates() ? &verdict : nullptr);
        print(bench::tableText(summaries) + choices + bench::verdictText(verdict));
        if (!options_.images.empty()) writeImages();
        if (!options_.report.empty()) bench::writeReport(options_.report, pageOf(summaries), results, set);
        const bool hasFiles = !(options_.csv + options_.gates.json + options_.images + options_.report).empty();
        requirePrinted(hasFiles ? "the requested files are complete" : "");
        conclude(verdict, baseline_ ? baseline_->path : options_.model);
    }

private:
    static void tellShortfall(const std::vector<bench::RunResult>& results) {
        telemetry::Shortfall shortfall;
        for (const bench::RunResult& result : results)
            for (const telemetry::FrameRow& row : result.rows)
                shortfall.add(row);
        if (const std::string line = task::shortfallLine(shortfall); !line.empty()) printWarning(line);
    }

    bench::BenchWalks walks() { return {session_, path_, runs_, options_.walk}; }

    bool hasGates() const { return baseline_ || bounds_.budgetMs; }

    void print(const std::string& text) const {
        if (!options_.gates.writesJsonToStdout()) std::fputs(text.c_str(), stdout);
    }

    /// Throws GatesFailed before the measurements if the context of the baseline differs.
    void requireComparable() {
        bounds_.gates.alikeKeys = bench::alikeKeys(*baseline_, context_, false);
        bench::Verdict verdict;
        verdict.gates = bench::contextGates(*baseline_, context_, bounds_.gates);
        if (verdict.gates.empty()) return;
        files_.writeVerdict(verdict);
        conclude(verdict, baseline_->path);
    }

    /// Returns the recommended runs. Adds the gate of the budget to `verdict`.
    std::string choicesText(const std::vector<report::RunSummary>& summaries, bench::Verdict& verdict) {
        std::string text = bench::recommendationText(summaries, bounds_.maxWrongShare);
        const auto isKnown = [](const report::RunSummary& run) { return report::wrongPixels(run).has_value(); };
        if (!text.empty() && std::none_of(summaries.begin(), summaries.end(), isKnown))
            text += "--oracle compares the runs with the ground truth.\n";
        const auto again = [this](std::size_t run) { return walkedAgain(run); };
        if (bounds_.budgetMs) {
            const bench::BudgetChoice choice =
                bench::underBudget({bounds_.maxWrongShare, bounds_.budgetMs}, summaries, again);
            text += choice.text;
            bench::Gate gate;
            gate.quantity = "budget";
            gate.before = formatted("a run within %g ms", *bounds_.budgetMs);
            gate.after = choice.hasRun ? "one" : "none";
            gate.decision = choice.hasRun ? bench::Decision::Pass : bench::Decision::Fail;
            gate.fails = !choice.hasRun;
            verdict.gates.push_back(gate);
        }
        if (summaries.size() > 1) text += bench::underBoundText(runs_.front().settings.quality.maxAliasing, summaries);
        return text;
    }

    void shorten() {
        const int wanted = options_.walk.frames;
        options_.walk.frames = bench::quickFrames(session_, path_, runs_, options_.walk);
        options_.walk.provenFrames = std::min(options_.walk.provenFrames, options_.walk.frames);
        if (options_.walk.frames < wanted)
            printMessage(
                "--quick draws " + std::to_string(options_.walk.frames) + " of " + std::to_string(wanted) +
                " frames per run, because a frame of this model takes long");
    }

    /// Returns a progress display for a stage with `frames` frames.
    std::unique_ptr<Progress> staged(const char* stage, std::size_t frames) const {
        auto progress = makeProgress(options_.common);
        progress->stage(stage, "frames", frames);
        return progress;
    }

    std::vector<bench::RunResult> walked() {
        return bench::walkAll(walks(), *staged("bench", bench::frameCount(runs_, options_.walk)));
    }

    report::RunSummary walkedAgain(std::size_t run) {
        bench::WalkOptions walk = options_.walk;
        walk.groundTruth = validation::GroundTruth::None;
        const auto progress = staged("once more", bench::frameCount({runs_[run]}, walk));
        return bench::summarize(bench::walkAgain(walks(), run, *progress));
    }

    void writeImages() {
        const auto progress = staged("pictures", bench::kFramesOfPictures * runs_.size());
        for (std::size_t run = 0; run < runs_.size(); ++run)
            bench::writePictures(
                options_.images, run, bench::middlePictures(session_, path_, runs_[run], options_.walk, *progress));
    }

    report::Report pageOf(const std::vector<report::RunSummary>& summaries) {
        report::Report page;
        page.model = context_.at("model") + ", " + context_.at("model_triangles") + " triangles";
        page.context = context_;
        page.runs = summaries;
        const std::vector<std::size_t> pictured = bench::picturedRuns(summaries);
        const auto progress = staged("pictures", bench::kFramesOfPictures * pictured.size());
        page.pictures = bench::middlePicturesOfAll(walks(), pictured, *progress);
        const settings::Settings& settings = runs_.front().settings;
        plan::View view = settings::viewOf(settings, session_.model().summary());
        view.camera = path::cameraAt(path_, path_.keyframes.front().time);
        page.storage = bench::storagePoints(session_.renderer().plan(view, settings::qualityOf(settings)));
        return page;
    }

    BenchOptions options_;
    Bounds bounds_;
    std::vector<bench::BenchRun> runs_;
    path::CameraPath path_;
    std::optional<bench::ResultSet> baseline_;
    task::Session session_;
    PreparedFile csv_;
    GateFiles files_;
    std::map<std::string, std::string> context_;
    PreparedFolder images_;
    PreparedFolder report_;
};

/// Measures this program and another one alternately.
void runAgainst(const BenchOptions& options) {
    if (!(options.csv + options.images + options.report + options.budgetMs + options.maxWrongPixels).empty())
        throw settings::UsageError{
            "--against",
            "--against has no --csv, --images, --report, --budget-ms and --max-wrong-pixels: run a bench without it"};
    Comparison comparison;
    comparison.repetitions = options.repetitions.value_or(kRepetitionsAgainst);
    comparison.measure = benchOnce;
    comparison.limits = boundsOf(options).gates;
    comparison.limits.pairing = bench::Pairing::Repetitions;
    comparison.limits.allowsOtherModel = !options.againstModel.empty();
    comparison.isSilent = options.gates.writesJsonToStdout();
    static_cast<void>(runsOf(options)); // a contradiction of options fails here, not in a child process
    GateFiles files(options.gates);
    const auto progress = makeProgress(options.common);
    progress->stage("bench", "repetitions", 2 * static_cast<std::uint64_t>(comparison.repetitions));
    const bench::Side before{
        std::filesystem::absolute(options.gates.against).string(), wordsOfSide(options.model, options.againstModel)};
    const bench::Side after{bench::ownProgram(), wordsOfSide(options.model, "")};
    compareSides(before, after, comparison, files, *progress);
}

void runBench(BenchOptions options) {
    const ThreadLimit limit(options.common);
    settings::requireDistinctFiles(
        {{"MODEL", options.model}, {"--path", options.path}, {"--baseline", options.gates.baseline}},
        {{"--csv", options.csv},
         {"--json-file", options.gates.writesJsonToStdout() ? "" : options.gates.json},
         {"--verdict", options.gates.verdict},
         {"--summary-md", options.gates.summaryMd},
         {"--bmf", options.gates.bmf},
         {"--action-json", options.gates.actionJson}});
    options.walk = walkOf(options);
    if (!options.gates.against.empty()) return runAgainst(options);
    if (!options.againstModel.empty())
        throw settings::UsageError{"--against-model", "--against-model needs --against, which names the other program"};
    Bench(options).run();
}

/// Returns the names of all options that accept a list of values in a bench.
std::string sweptOptions() {
    constexpr int kPerLine = 5;
    std::string options;
    int count = 0;
    for (const settings::Setting& setting : settings::table())
        if (setting.description().isSwept) options += (count++ % kPerLine == 0 ? "\n  " : " ") + setting.option();
    return options;
}

} // namespace

void addBenchCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand(
        "bench", "Measure frame times and shadow errors along a camera path, for combinations of options");
    auto options = std::make_shared<BenchOptions>();
    addModel(*command, options->model);
    command->get_option("MODEL")->required(false)->option_text(manual::kRequiredWithoutSubcommand);
    command->add_option("--path", options->path, "Camera path, such as gnomon path writes")
        ->option_text(manual::kRequiredWithoutSubcommand)
        ->type_name("FILE.json");
    const auto count = [&](const char* flag, int& value, const char* help, int min) {
        command->add_option(flag, value, help)->check(CLI::Range(min, 1000000))->type_name("N")->capture_default_str();
    };
    count("--frames", options->walk.frames, "Frames per run, evenly spaced along the path", 1);
    command->add_option("--repetitions", options->repetitions, "Repetitions of each run")
        ->check(CLI::Range(1, 1000000))
        ->type_name("R")
        ->default_str("1, or 3 with --report");
    count("--warmup", options->walk.warmup, "Frames before each repetition that are not logged", 0);
    command->add_flag(
        settings::withOldNames("--no-wait"),
        options->walk.isRealTime,
        "Do not wait for pages; draw coarser triangles until they arrive");
    addOracleOption(*command, options->walk.groundTruth);
    command->add_flag("--quick", options->isQuick, "First impression within two minutes: at most 8 frames per run");
    CLI::Option* shadowMaps = command->add_option_function<std::string>(
        "--shadow-maps",
        [options](const std::string& text) { options->shadowMaps = text; }, // a plain option would ignore an empty text
        "List of numbers of shadow maps: --z-partitions with these numbers, without face partitions");
    shadowMaps->type_name("K,...");
    command->add_option("--csv", options->csv, "Write one row per frame")->type_name("FILE.csv");
    CLI::Option* images = command->add_option(
        "--images", options->images, "Write six pictures of the middle frame of each run to a folder");
    images->type_name("DIR");
    command->add_flag("--all-images", options->hasAllImages, "With --images: write every frame of each run")
        ->needs(images);
    command->add_option("--report", options->report, "Write a web page to a folder: error against frame time per run")
        ->type_name("DIR");
    command->add_option("--budget-ms", options->budgetMs, "Print the most accurate run with a frame time below T ms")
        ->type_name("T");
    addGateOptions(*command, options->gates);
    command->add_option("--against-model", options->againstModel, "With --against: the model of the other program")
        ->type_name("OLD.gnm");
    command
        ->add_option(
            "--max-wrong-pixels", options->maxWrongPixels, "Recommend the fastest run with at most P% wrong pixels")
        ->type_name("P");
    command->footer(
        "These options accept a list such as --shadows maps,exact. Each combination of values is one run:" +
        sweptOptions() + "\nWithout a list, --report compares a standard set of runs.");
    options->settings.addTo(*command);
    shadowMaps->excludes("--z-partitions");
    addCommonOptions(*command, options->common);
    CLI::App* build = addBenchBuildCommand(*command);
    command->callback([options, build] {
        if (build->parsed()) return;
        for (const auto& [name, text] : {std::pair{"MODEL", options->model}, std::pair{"--path", options->path}})
            if (text.empty())
                throw settings::UsageError{name, std::string(name) + " is required; see gnomon bench --help"};
        runBench(*options);
    });
}

} // namespace gnomon::app
