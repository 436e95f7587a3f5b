#include "app/command_line.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/thread_limit.h"
#include "core/error.h"
#include "hierarchy/source/open_source.h"
#include "settings/backend_choice.h"
#include "settings/files/named_files.h"
#include "settings/output.h"
#include "settings/resolve.h"
#include "settings/table.h"
#include "viewer/input/key_table.h"
#include "viewer/viewer.h"

#include <filesystem>
#include <memory>

namespace gnomon::app {

namespace {

/// Throws UsageError for wrong options, before a window opens or a mesh is built.
void requireSound(const viewer::ViewerOptions& options) {
    const settings::Settings& settings = options.settings;
    settings::requireCapable(settings, options.colors);
    settings::viewOf(settings, hierarchy::ModelSummary());
    settings::requireApart(
        {{"MODEL", options.file}, {"--path", options.path}, {"--camera", settings.cameraFile}},
        {{"--csv", options.csv}});
    if (settings.backend == settings::Backend::Osmesa || settings.backend == settings::Backend::Egl)
        throw settings::UsageError{
            "--backend",
            settings::optionText("backend", settings) + " draws into no window; take auto, software or window"};
    if (!hierarchy::isAddress(options.file) && !std::filesystem::exists(options.file))
        throw Error(options.file, "this model cannot be opened", "a file", "none");
}

} // namespace

void addViewCommand(CLI::App& program) {
    struct Options {
        CommonOptions common;
        viewer::ViewerOptions viewer;
        SettingOptions settings;
        settings::ValueColorWords colors;
        std::string frames;
        std::string buildMemory = "2G";
    };

    CLI::App* command = program.add_subcommand("view", "Walk through a model in a window; H there lists the keys");
    auto options = std::make_shared<Options>();
    viewer::ViewerOptions& viewer = options->viewer;
    command
        ->add_option(
            "MODEL", viewer.file, "A .gnm or its http(s):// address, or a mesh: it is built into MESH.gnm beside it")
        ->required();
    addServerOptions(*command);
    command
        ->add_option(
            "--target-ms",
            viewer.targetMs,
            "Hold this frame time in motion by less detail, maps, texels, resolution; 0 is none")
        ->check(CLI::Range(0.0, 10000.0))
        ->capture_default_str();
    command->add_option("--samples", viewer.samples, "At rest, frames that the picture becomes the mean of")
        ->check(CLI::Range(1, settings::kMostSamples))
        ->capture_default_str();
    command->add_option("--path", viewer.path, "Play this camera path from the start");
    CLI::Option* frames =
        command->add_option("--frames", options->frames, "Play it in so many frames, as bench does, not by the clock");
    command->add_option("--images", viewer.images, "Write each played frame into this folder, and end with --path");
    command->add_option("--csv", viewer.csv, "Write a row per frame here, in the columns of bench");
    command->add_option("--build-memory", options->buildMemory, "Peak resident size while a mesh is built")
        ->capture_default_str();
    command
        ->add_option(
            "--source-root",
            viewer.sourceRoot,
            "Folder that files of a mesh may come from (default: the folder of the mesh)")
        ->check(CLI::ExistingDirectory);
    addColorOptions(*command, options->colors);
    options->settings.addTo(*command);
    addCommonOptions(*command, options->common);
    frames->needs("--path");
    command->footer(viewer::keysForPeople());
    command->callback([options] {
        viewer::ViewerOptions& chosen = options->viewer;
        if (!options->frames.empty())
            chosen.frames = settings::parsed(settings::whole(1, 1000000), "--frames", options->frames);
        chosen.buildMemory = settings::parsed(settings::memory(), "--build-memory", options->buildMemory);
        chosen.settings = options->settings.settings();
        chosen.colors = settings::valueColors(options->colors);
        chosen.tell = printMessage;
        chosen.threads = options->common.threads;
        const ThreadLimit limit(options->common);
        requireSound(chosen);
        CommonOptions silent;
        silent.progress = "none";
        viewer::runViewer(chosen, *makeProgress(silent)); // this progress throws Interrupted after Ctrl-C
    });
}

} // namespace gnomon::app
