#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/oracle_option.h"
#include "app/thread_limit.h"
#include "bench/baseline.h"
#include "bench/bench_output.h"
#include "bench/bench_text.h"
#include "bench/report_runs.h"
#include "bench/summarize.h"
#include "core/prepared_output.h"
#include "settings/codec.h"
#include "settings/contradictions.h"
#include "settings/files/named_files.h"
#include "settings/old_names.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "telemetry/shortfall.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <memory>

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
    std::string json;
    std::string images;
    bool hasAllImages = false;
    std::string report;
    std::optional<int> repetitions;
    bool isQuick = false;
    std::string budgetMs;
    std::string baseline;
    std::string failAbovePercent = "10";
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
    if (!options.report.empty() && !isProven && !walk.isRealTime) {
        walk.groundTruth = validation::GroundTruth::SameDetail;
        walk.countsWrongPixels = true;
        walk.provenFrames = options.isQuick ? 3 : 8;
    }
    return walk;
}

/// The limits that a bench must not exceed: those of --fail-above (percent) and --budget-ms (ms).
struct Bounds {
    double failAbovePercent = 0;
    std::optional<double> budgetMs;
};

/// Parses the limits of --fail-above and --budget-ms. Throws UsageError for a negative percentage, or for a budget of 0
/// or less.
Bounds boundsOf(const BenchOptions& options) {
    const auto nonNegative = settings::number("a number of at least 0", [](double value) { return value >= 0; });
    Bounds bounds{settings::parsed(nonNegative, "--fail-above", options.failAbovePercent), std::nullopt};
    if (!options.budgetMs.empty())
        bounds.budgetMs = settings::parsed(settings::positiveNumber(), "--budget-ms", options.budgetMs);
    return bounds;
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
    std::vector<bench::BenchRun> runs =
        bench::runsOf(settings::combinations(fixed, options.settings.axes(options.shadowMaps)));
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
          baseline_(options.baseline.empty() ? std::nullopt : std::optional(bench::readBaseline(options.baseline))),
          session_(options.model, bench::backendSettings(runs_), printWarning, backendOf(runs_)),
          csv_(options.csv),
          json_(options.json),
          images_(options.images),
          report_(options.report) {
        if (options.isQuick) shorten();
        context_ = bench::statedFacts(runs_, path_, options_.walk, session_);
        context_["path"] = std::filesystem::path(options.path).filename().string();
        context_["version"] = GNOMON_VERSION;
        context_["threads"] = std::to_string(ThreadLimit::current());
        if (baseline_) bench::requireComparable(*baseline_, context_);
        if (options.hasAllImages)
            options_.walk.onPicture = [folder = options.images](auto run, int frame, auto png) {
                bench::writeFramePicture(folder, run, frame, png);
            };
    }

    void run() {
        const std::vector<bench::RunResult> results = walked();
        std::vector<report::RunSummary> summaries;
        std::transform(results.begin(), results.end(), std::back_inserter(summaries), bench::summarize);
        context_["first_frame_ms"] = std::to_string(results.front().firstFrameMs);
        tellShortfall(results);
        csv_.write(bench::csvText(results)); // first, because a later step can be interrupted
        json_.write(bench::benchmarkText(context_, results));
        std::fputs(bench::tableText(summaries).c_str(), stdout);
        std::fputs(choicesText(summaries).c_str(), stdout);
        if (!options_.images.empty()) writeImages();
        if (!options_.report.empty()) bench::writeReport(options_.report, pageOf(summaries), results);
        const bool hasFiles = !(options_.csv + options_.json + options_.images + options_.report).empty();
        requirePrinted(hasFiles ? "the requested files are complete" : "");
        if (baseline_) {
            for (const std::string& name : bench::notCompared(*baseline_, summaries))
                printMessage(
                    baseline_->path + ": only one of the two benches has this run, so it is not compared: " + name);
            bench::requireComplete(*baseline_, summaries, !options_.walk.isRealTime);
            bench::requireNotSlower(*baseline_, summaries, bounds_.failAbovePercent);
        }
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

    std::string choicesText(const std::vector<report::RunSummary>& summaries) {
        std::string text;
        const auto again = [this](std::size_t run) { return walkedAgain(run); };
        if (bounds_.budgetMs) text += bench::underBudgetText(*bounds_.budgetMs, summaries, again);
        if (summaries.size() > 1) text += bench::underBoundText(runs_.front().settings.quality.maxAliasing, summaries);
        if (baseline_) text += bench::changesText(*baseline_, summaries, bounds_.failAbovePercent);
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
    std::optional<bench::Baseline> baseline_;
    task::Session session_;
    PreparedFile csv_;
    PreparedFile json_;
    std::map<std::string, std::string> context_;
    PreparedFolder images_;
    PreparedFolder report_;
};

void runBench(BenchOptions options) {
    const ThreadLimit limit(options.common);
    settings::requireDistinctFiles(
        {{"MODEL", options.model}, {"--path", options.path}, {"--baseline", options.baseline}},
        {{"--csv", options.csv}, {"--json-file", options.json}});
    options.walk = walkOf(options);
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
    command->add_option("--path", options->path, "Camera path, such as gnomon path writes")
        ->required()
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
    command->add_option("--json-file", options->json, "Write the runs in the format of Google Benchmark")
        ->type_name("FILE.json");
    CLI::Option* images = command->add_option(
        "--images", options->images, "Write six pictures of the middle frame of each run to a folder");
    images->type_name("DIR");
    command->add_flag("--all-images", options->hasAllImages, "With --images: write every frame of each run")
        ->needs(images);
    command->add_option("--report", options->report, "Write a web page to a folder: error against frame time per run")
        ->type_name("DIR");
    command->add_option("--budget-ms", options->budgetMs, "Print the most accurate run with a frame time below T ms")
        ->type_name("T");
    command->add_option("--baseline", options->baseline, "Compare with the --json-file of an earlier bench")
        ->type_name("FILE.json");
    command
        ->add_option("--fail-above", options->failAbovePercent, "Max growth of a median since --baseline, in percent")
        ->type_name("PERCENT")
        ->capture_default_str();
    command->footer(
        "These options accept a list such as --shadows maps,exact. Each combination of values is one run:" +
        sweptOptions() + "\nWithout a list, --report compares a standard set of runs.");
    options->settings.addTo(*command);
    shadowMaps->excludes("--z-partitions");
    addCommonOptions(*command, options->common);
    command->callback([options] { runBench(*options); });
}

} // namespace gnomon::app
