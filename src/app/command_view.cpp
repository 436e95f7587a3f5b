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

/// Throws UsageError if options of `gnomon view` are invalid or contradict each other. Runs before a window opens or a
/// mesh is built.
void requireSound(const viewer::ViewerOptions& options) {
    const settings::Settings& settings = options.settings;
    settings::requireCapable(settings, options.colors);
    settings::viewOf(settings, hierarchy::ModelSummary());
    settings::requireDistinctFiles(
        {{"MODEL", options.file}, {"--path", options.path}, {"--camera", settings.cameraFile}},
        {{"--csv", options.csv}});
    if (settings.backend == settings::Backend::Osmesa || settings.backend == settings::Backend::Egl)
        throw settings::UsageError{
            "--backend",
            settings::optionText("backend", settings) + " cannot draw to a window; use auto, software or window"};
    if (!hierarchy::isAddress(options.file) && !std::filesystem::exists(options.file))
        throw Error(options.file, "cannot open the model", "a file", "none");
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

    CLI::App* command =
        program.add_subcommand("view", "Open a window and walk through a model; the key H lists all keys");
    auto options = std::make_shared<Options>();
    viewer::ViewerOptions& viewer = options->viewer;
    command->add_option("MODEL", viewer.file, "A .gnm file, its http(s):// address, or a mesh, which becomes MESH.gnm")
        ->required();
    addServerOptions(*command);
    command->add_option("--target-ms", viewer.targetMs, "Max frame time in motion in ms; 0 is no limit")
        ->check(CLI::Range(0.0, 10000.0))
        ->type_name("T")
        ->capture_default_str();
    command->add_option("--samples", viewer.samples, "Frames that are averaged while the camera rests")
        ->check(CLI::Range(1, settings::kMaxSamples))
        ->type_name("N")
        ->capture_default_str();
    command->add_option("--path", viewer.path, "Camera path to play at the start")->type_name("FILE.json");
    CLI::Option* frames = command->add_option(
        "--frames", options->frames, "Play --path in this number of frames, as bench does, and not in real time");
    frames->type_name("N");
    command
        ->add_option(
            "--images", viewer.images, "Write each frame of --path to this folder, and close the window at its end")
        ->type_name("DIR");
    command->add_option("--csv", viewer.csv, "Write one row per frame, with the columns of bench")
        ->type_name("FILE.csv");
    command->add_option("--build-memory", options->buildMemory, "Max resident memory while a mesh is converted")
        ->type_name("SIZE")
        ->capture_default_str();
    command
        ->add_option(
            "--source-root",
            viewer.sourceRoot,
            "Folder that textures, buffers and material libraries of a mesh may come from")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->default_str("the folder of the mesh");
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
