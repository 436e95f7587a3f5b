#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/oracle_option.h"
#include "app/thread_limit.h"
#include "task/render.h"

#include <cstdio>
#include <memory>
#include <utility>

namespace gnomon::app {

namespace {

struct RenderOptions {
    CommonOptions common;
    task::RenderTask task;
};

/// The words of the command line that are not typed yet.
struct RenderWords {
    SettingOptions settings;
    settings::ValueColorWords colors;
};

void streamToStdout(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) requirePrinted();
}

/// Turns the words and files that the command line names into values. Throws UsageError and Error.
task::RenderTask taskOf(settings::Request request, const RenderWords& words) {
    request.settings = words.settings.parsed();
    request.output.colors = settings::valueColors(words.colors);
    requireNoWindow(request.settings);
    task::RenderTask task = task::renderTask(std::move(request));
    task.warn = printWarning;
    task.stream = streamToStdout;
    return task;
}

void runRender(const RenderOptions& options) {
    const ThreadLimit limit(options.common);
    const Polling polling = options.task.output.isSeries() ? Polling::Yes : Polling::No;
    task::render(options.task, *makeProgress(options.common, polling));
    requirePrinted();
}

/// Adds the options that say which pictures are drawn.
void addPictures(CLI::App& command, settings::Output& output) {
    command
        .add_option("-o,--output", output.picture, "The picture, a PNG; of many frame%04d.png, or - for a y4m stream")
        ->required()
        ->type_name("FILE.png");
    std::vector<std::string> overlays;
    for (const auto& each : render::kOverlays)
        overlays.emplace_back(each.word);
    command
        .add_option_function<std::string>(
            "--overlay",
            [&output](const std::string& word) { output.overlay = *valueOf(render::kOverlays, word); },
            "What is painted over the picture")
        ->check(CLI::IsMember(overlays))
        ->default_str("none");
    command.add_option("--path", output.path, "Draw pictures along this camera path, to frame%04d.png or to - (y4m)");
    command.add_option("--frames", output.frames, "Pictures of --path, evenly over it [60]")
        ->check(CLI::Range(1, 1000000));
    command.add_option("--turntable", output.turntable, "Draw so many pictures all around the target, likewise")
        ->check(CLI::Range(1, 1000000));
    command.add_option("--time", output.time, "--camera is a path; draw its camera at so many seconds");
    command
        .add_option(
            "--samples",
            output.samples,
            "Frames that each picture is the mean of, each with its own place in the pixels [16; 1 beside --stats, "
            "--oracle, --reference, --depth, --shadow-depth and --overlay]")
        ->check(CLI::Range(1, settings::kMostSamples));
}

/// Adds the options of what is written and compared beside one picture.
void addFiles(CLI::App& command, settings::Output& output) {
    command.add_option("--stats", output.statistics, "Write the frame's row of the log here, as JSON")
        ->type_name("FILE.json");
    command.add_option("--reference", output.reference, "Compare with this PNG; exit 1 if it differs more")
        ->type_name("FILE.png");
    command
        .add_option(
            "--reference-threshold", output.referenceThreshold, "Largest mean difference, fraction of full scale")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command.add_option("--depth", output.depth, "Write view depth here, a PFM; infinity where nothing is")
        ->type_name("FILE.pfm");
    command.add_option("--shadow-depth", output.shadowDepth, "Write each shadow map into this folder, as PFM")
        ->type_name("DIR");
    addOracleOption(command, output.oracle);
}

} // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Draw one picture of a model with its shadows");
    auto options = std::make_shared<RenderOptions>();
    auto words = std::make_shared<RenderWords>();
    auto request = std::make_shared<settings::Request>();
    addModel(*command, request->model);
    addPictures(*command, request->output);
    addColorOptions(*command, words->colors);
    addFiles(*command, request->output);
    words->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->callback([options, words, request] {
        options->task = taskOf(*request, *words);
        runRender(*options);
    });
}

} // namespace gnomon::app
