#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/named_files.h"
#include "app/oracle_option.h"
#include "app/thread_limit.h"
#include "core/file.h"
#include "core/prepared_output.h"
#include "executor/overlay/legend.h"
#include "executor/shadow_depth_files.h"
#include "measure/picture_series.h"
#include "measure/session.h"
#include "path/camera_path.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "telemetry/process_clock.h"

#include <cstdio>
#include <optional>
#include <utility>

namespace gnomon::app {

namespace {

struct RenderOptions {
    CommonOptions common;
    SettingOptions settings;
    std::string model;
    std::string output;
    std::string overlay = "none";
    std::string statistics;
    std::string reference;
    double referenceThreshold = 0.01;
    std::string depth;
    std::string shadowDepth;
    OracleOption oracle;
    settings::PictureSeries series;
    std::optional<double> time;
};

/// The path whose camera at --time is asked for, taken out of `settings`, where it stands for a camera.
std::optional<path::CameraPath> pathOfTime(const RenderOptions& options, settings::Settings& settings) {
    if (!options.time) return std::nullopt;
    if (settings.cameraFile.empty()) throw settings::UsageError{"--time is of a path: --camera PATH.json --time T"};
    const std::string file = std::exchange(settings.cameraFile, {});
    if (settings::isPosed(settings))
        throw settings::UsageError{"--camera and --eye, --target, --up, --fov-y contradict each other"};
    return path::readCameraPath(file);
}

/// Pictures in number, which none of the options of a single one is for.
void runSeries(const RenderOptions& options, const settings::Settings& settings) {
    if (!(options.statistics + options.reference + options.depth + options.shadowDepth).empty() || options.time ||
        options.oracle.mode() != proof::Oracle::None)
        throw settings::UsageError{
            "--stats, --reference, --depth, --shadow-depth, --oracle, --time are of one picture"};
    if (options.output != "-") requireExtension("--output", options.output, ".png");
    measure::SeriesTask task{options.model, {}, settings, printWarning, {}};
    task.overlay = valueOf(executor::kOverlays, options.overlay).value_or(executor::Overlay::None);
    task.stream = [](const std::string& bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), stdout) != bytes.size()) requirePrinted();
    };
    measure::drawSeries(options.series, task, *makeProgress(options.common));
    requirePrinted();
}

/// Throws Error where an output cannot be made: drawing may take long.
void requireWritableOutputs(const RenderOptions& options) {
    for (const std::string& path : {options.output, options.statistics, options.depth})
        requireWritable(path);
}

void runRender(const RenderOptions& options) {
    const ThreadLimit limit(options.common);
    settings::Settings settings = options.settings.settings();
    requireNoWindow(settings);
    if (options.series.isAsked() || options.series.frames) return runSeries(options, settings);
    if (!options.shadowDepth.empty()) options.settings.requireMapsFor("--shadow-depth");
    const executor::Overlay overlay = valueOf(executor::kOverlays, options.overlay).value_or(executor::Overlay::None);
    if (!options.shadowDepth.empty() || proof::isOfMaps(options.oracle.mode()) || executor::isOfMaps(overlay))
        settings::askForMaps(settings);
    requireExtension("--output", options.output, ".png");
    requireApart(
        {{"MODEL", options.model}, {"--camera", settings.cameraFile}, {"--reference", options.reference}},
        {{"--output", options.output}, {"--stats", options.statistics}, {"--depth", options.depth}});
    const std::optional<path::CameraPath> timed = pathOfTime(options, settings);
    const plan::Quality quality = settings::qualityOf(settings);
    const bool isTransparent = quality.look.background.kind == plan::Background::Kind::Transparent;
    if (isTransparent && overlay != executor::Overlay::None)
        throw settings::UsageError{
            "--background transparent and --overlay contradict each other: an overlay's legend lies on the background"};
    measure::Session session(options.model, settings, printWarning);
    plan::View view = settings::viewOf(settings, session.model().summary());
    if (timed) view.camera = path::cameraAt(*timed, *options.time);
    std::optional<executor::Picture> reference;
    if (!options.reference.empty()) reference = executor::readPng(options.reference);
    requireWritableOutputs(options);
    const PreparedFolder shadowDepth(options.shadowDepth);
    frame::FrameOptions frameOptions;
    frameOptions.overlay = overlay;
    frameOptions.wantsWholeMaps = !options.shadowDepth.empty();
    const auto progress = makeProgress(options.common, Polling::No);
    progress->stage("render", "pictures", 1);
    frame::Frame frame = session.renderer().render(view, quality, frameOptions);
    proof::ProofOptions proofOptions;
    proofOptions.measuresAliasing = !options.statistics.empty();
    proofOptions.oracle = options.oracle.mode();
    proofOptions.comparesWithFinest = proofOptions.oracle != proof::Oracle::None;
    proof::setAccuracy(proof::prove(session.renderer(), frame, proofOptions), frame.row);
    executor::Picture picture = session.executor().picture();
    executor::drawLegend(picture, executor::legendOf(frameOptions.overlay, frame.plan));
    std::optional<executor::Coverage> coverage;
    if (isTransparent) coverage = executor::coverageOf(session.executor().viewDepth());
    executor::writePng(options.output, picture, coverage);
    progress->advance(1);
    if (!options.depth.empty()) executor::writePfm(options.depth, session.executor().viewDepth());
    if (!options.shadowDepth.empty()) executor::writeShadowMaps(options.shadowDepth, frame.plan, session.executor());
    if (!options.statistics.empty()) {
        telemetry::FrameRow row = frame.row;
        row.run = "render";
        row.sinceStartMs = telemetry::sinceProcessStart().count;
        writeTextFile(options.statistics, telemetry::jsonObject(row) + "\n");
    }
    if (reference) executor::requireAlike({options.reference, *reference}, picture, options.referenceThreshold);
}

} // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("render", "Draw one picture of a model with its shadows");
    auto options = std::make_shared<RenderOptions>();
    command->add_option("MODEL", options->model, "A .gnm file")->required();
    command
        ->add_option("-o,--output", options->output, "The picture, a PNG; of many frame%04d.png, or - for a y4m stream")
        ->required()
        ->type_name("FILE.png");
    std::vector<std::string> words;
    words.reserve(executor::kOverlays.size());
    for (const executor::NamedOverlay& overlay : executor::kOverlays)
        words.emplace_back(overlay.word);
    command->add_option("--overlay", options->overlay, "What is painted over the picture")
        ->check(CLI::IsMember(words))
        ->capture_default_str();
    command->add_option("--stats", options->statistics, "Write the frame's row of the log here, as JSON")
        ->type_name("FILE.json");
    command->add_option("--reference", options->reference, "Compare with this PNG; exit 1 if it differs more")
        ->type_name("FILE.png");
    command
        ->add_option(
            "--reference-threshold", options->referenceThreshold, "Largest mean difference, fraction of full scale")
        ->check(CLI::Range(0.0, 1.0))
        ->capture_default_str();
    command->add_option("--depth", options->depth, "Write view depth here, a PFM; infinity where nothing is")
        ->type_name("FILE.pfm");
    command->add_option("--shadow-depth", options->shadowDepth, "Write each shadow map into this folder, as PFM")
        ->type_name("DIR");
    options->oracle.addTo(*command);
    settings::PictureSeries& series = options->series;
    command->add_option("--path", series.path, "Draw pictures along this camera path, to frame%04d.png or to - (y4m)");
    command->add_option("--frames", series.frames, "Pictures of --path, evenly over it [60]")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--turntable", series.turntable, "Draw so many pictures all around the target, likewise")
        ->check(CLI::Range(1, 1000000));
    command->add_option("--time", options->time, "--camera is a path; draw its camera at so many seconds");
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    command->callback([options] {
        options->series.output = options->output;
        runRender(*options);
    });
}

} // namespace gnomon::app
