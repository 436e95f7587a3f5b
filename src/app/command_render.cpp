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

/// The values of those options of `gnomon render` that are parsed after all options are known.
struct RenderWords {
    SettingOptions settings;
    settings::ValueColorWords colors;
};

void streamToStdout(const std::string& bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) requirePrinted();
}

/// Converts the options in `request` and the values in `words` to a task for drawing. Reads the files that they name.
/// Throws UsageError and Error.
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

/// Adds the options that select which pictures `gnomon render` draws.
void addPictures(CLI::App& command, settings::Output& output) {
    command.add_option("-o,--output", output.picture, "PNG to write; a series needs frame%04d.png, or - (y4m)")
        ->required()
        ->type_name("FILE.png");
    std::vector<std::string> overlays;
    overlays.reserve(render::kOverlays.size());
    for (const auto& each : render::kOverlays)
        overlays.emplace_back(each.word);
    command
        .add_option_function<std::string>(
            "--overlay",
            [&output](const std::string& word) { output.overlay = *valueOf(render::kOverlays, word); },
            "Picture of internal data: none, partitions, texels or aliasing of shadow maps, lod, clusters, residency "
            "(missing pages) or projection")
        ->check(CLI::IsMember(overlays))
        ->type_name("KIND")
        ->default_str("none");
    command.add_option("--path", output.path, "Camera path, along which --frames pictures are drawn")
        ->type_name("FILE.json");
    command.add_option("--frames", output.frames, "Number of pictures along --path, evenly spaced in time")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N")
        ->default_str("60");
    command.add_option("--turntable", output.turntable, "Number of pictures on a full circle around the target")
        ->check(CLI::Range(1, 1000000))
        ->type_name("N");
    command.add_option("--time", output.time, "Time in seconds of the view, if --camera is a camera path")
        ->type_name("T");
    command.add_option("--samples", output.samples, "Frames averaged per picture")
        ->check(CLI::Range(1, settings::kMaxSamples))
        ->type_name("N")
        ->default_str(std::to_string(settings::kUsualSamples) + ", or 1 with data outputs");
}

/// Adds the options of `gnomon render` for the additional files of a picture and for comparisons.
void addFiles(CLI::App& command, settings::Output& output) {
    command
        .add_option(
            "--stats", output.statistics, "Write the time, the counts and the errors of the frame to a JSON file")
        ->type_name("FILE.json");
    command
        .add_option(
            "--reference",
            output.reference,
            "PNG that the picture is compared with; a larger difference is an error (exit 1)")
        ->type_name("FILE.png");
    command
        .add_option(
            "--reference-threshold",
            output.referenceThreshold,
            "Max mean difference from --reference, from 0 (identical) to 1 (black and white)")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("X")
        ->capture_default_str();
    command
        .add_option(
            "--depth",
            output.depth,
            "Write the depth of each pixel to a PFM file, in units of the model; the background is infinite")
        ->type_name("FILE.pfm");
    command
        .add_option(
            "--shadow-classes",
            output.shadowClasses,
            "Write the class of each pixel: 255 lit, 192 background, 128 within tolerance, 64 faces away, 0 dark; with "
            "--oracle exact, of the ground truth")
        ->type_name("FILE.png");
    command
        .add_option(
            "--shadow-depth", output.shadowDepth, "Write the depth of each shadow map to this folder, as PFM files")
        ->type_name("DIR");
    addOracleOption(command, output.groundTruth);
}

} // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App* command =
        program.add_subcommand("render", "Draw a picture of a model with its shadows, or a series of pictures");
    auto options = std::make_shared<RenderOptions>();
    auto words = std::make_shared<RenderWords>();
    auto request = std::make_shared<settings::Request>();
    addModel(*command, request->model);
    addPictures(*command, request->output);
    addColorOptions(*command, words->colors);
    addFiles(*command, request->output);
    words->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->footer(
        "A picture has a single frame by default with --overlay, --color-by, --oracle, --stats, --reference,\n"
        "--depth or --shadow-depth. All of them except --reference allow only --samples 1.");
    command->callback([options, words, request] {
        options->task = taskOf(*request, *words);
        runRender(*options);
    });
}

} // namespace gnomon::app
