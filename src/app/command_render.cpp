#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/oracle_option.h"
#include "app/thread_limit.h"
#include "measure/picture_series.h"
#include "measure/still_picture.h"
#include "path/camera_path.h"
#include "settings/files/named_files.h"
#include "settings/resolve.h"
#include "settings/samples.h"
#include "settings/table.h"

#include <cstdio>
#include <optional>
#include <utility>

namespace gnomon::app {

namespace {

struct RenderOptions {
    CommonOptions common;
    SettingOptions settings;
    measure::StillTask task;
    std::string overlay = "none";
    settings::ValueColorWords colors;
    OracleOption oracle;
    settings::PictureSeries series;
    std::optional<double> time;
};

/// Returns the camera path for --time, or nullopt without --time. Removes the file of the path from `settings`, where
/// it is given as the camera file.
std::optional<path::CameraPath> pathOfTime(const RenderOptions& options, settings::Settings& settings) {
    if (!options.time) return std::nullopt;
    if (settings.cameraFile.empty()) throw settings::UsageError{"--time is of a path: --camera PATH.json --time T"};
    const std::string file = std::exchange(settings.cameraFile, {});
    if (settings::isPosed(settings))
        throw settings::UsageError{"--camera and --eye, --target, --view, --fov-y contradict each other"};
    return path::projected(path::readCameraPath(file), settings.projection);
}

/// Draws a series of pictures. Throws UsageError for options that apply to a single picture only.
void runSeries(const RenderOptions& options, const measure::StillTask& still) {
    if (!(still.statistics + still.reference + still.depth + still.shadowDepth).empty() || options.time ||
        still.oracle != proof::Oracle::None)
        throw settings::UsageError{
            "--stats, --reference, --depth, --shadow-depth, --oracle, --time are of one picture"};
    if (still.output != "-") settings::requireExtension("--output", still.output, ".png");
    measure::SeriesTask task{still.model, still.overlay, still.settings, printWarning, {}, still.samples};
    task.stream = [](const std::string& bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) requirePrinted();
    };
    measure::drawSeries(options.series, task, *makeProgress(options.common));
    requirePrinted();
}

void runRender(const RenderOptions& options) {
    const ThreadLimit limit(options.common);
    measure::StillTask task = options.task;
    task.settings = options.settings.settings();
    task.warn = printWarning;
    task.overlay = valueOf(executor::kOverlays, options.overlay).value_or(executor::Overlay::None);
    task.colors = settings::valueColors(options.colors);
    if (task.colors.by != settings::ColorBy::None && (options.overlay != "none" || options.series.isAsked()))
        throw settings::UsageError{"--color-by is of one picture without an overlay"};
    task.oracle = options.oracle.mode();
    requireNoWindow(task.settings);
    if (options.series.isAsked() || options.series.frames) return runSeries(options, task);
    if (!task.shadowDepth.empty()) options.settings.requireMapsFor("--shadow-depth");
    if (!task.shadowDepth.empty() || proof::isOfMaps(task.oracle) || executor::isOfMaps(task.overlay))
        settings::askForMaps(task.settings);
    settings::requireExtension("--output", task.output, ".png");
    settings::requireApart(
        {{"MODEL", task.model}, {"--camera", task.settings.cameraFile}, {"--reference", task.reference}},
        {{"--output", task.output}, {"--stats", task.statistics}, {"--depth", task.depth}});
    if (const auto timed = pathOfTime(options, task.settings)) task.camera = path::cameraAt(*timed, *options.time);
    measure::drawStill(task, *makeProgress(options.common, Polling::No));
}

} // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Draw one picture of a model with its shadows");
    auto options = std::make_shared<RenderOptions>();
    measure::StillTask& task = options->task;
    addModel(*command, task.model);
    command->add_option("-o,--output", task.output, "The picture, a PNG; of many frame%04d.png, or - for a y4m stream")
        ->required()
        ->type_name("FILE.png");
    const auto wordsOf = [](const auto& named) {
        std::vector<std::string> all;
        all.reserve(named.size());
        for (const auto& each : named)
            all.emplace_back(each.word);
        return all;
    };
    command->add_option("--overlay", options->overlay, "What is painted over the picture")
        ->check(CLI::IsMember(wordsOf(executor::kOverlays)))
        ->capture_default_str();
    addColorOptions(*command, options->colors);
    command->add_option("--stats", task.statistics, "Write the frame's row of the log here, as JSON")
        ->type_name("FILE.json");
    command->add_option("--reference", task.reference, "Compare with this PNG; exit 1 if it differs more")
        ->type_name("FILE.png");
    command
        ->add_option(
            "--reference-threshold", task.referenceThreshold, "Largest mean difference, fraction of full scale")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_option("--depth", task.depth, "Write view depth here, a PFM; infinity where nothing is")
        ->type_name("FILE.pfm");
    command->add_option("--shadow-depth", task.shadowDepth, "Write each shadow map into this folder, as PFM")
        ->type_name("DIR");
    options->oracle.addTo(*command);
    settings::PictureSeries& series = options->series;
    command->add_option("--path", series.path, "Draw pictures along this camera path, to frame%04d.png or to - (y4m)");
    command->add_option("--frames", series.frames, "Pictures of --path, evenly over it [60]")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--turntable", series.turntable, "Draw so many pictures all around the target, likewise")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--time", options->time, "--camera is a path; draw its camera at so many seconds");
    command
        ->add_option(
            "--samples",
            task.samples,
            "Frames that each picture is the mean of, each with its own place in the pixels [16; 1 beside --stats, "
            "--oracle, --reference, --depth, --shadow-depth and --overlay]")
        ->check(CLI::Range(1, settings::kMostSamples));
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->callback([options] {
        options->series.output = options->task.output;
        runRender(*options);
    });
}

} // namespace gnomon::app
