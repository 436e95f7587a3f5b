#include "app/commands.h"
#include "app/thread_limit.h"
#include "core/error.h"
#include "core/file.h"
#include "core/units.h"
#include "hierarchy/source_cameras.h"
#include "path/suited_path.h"
#include "preprocess/read/open_mesh_sources.h"
#include "preprocess/read/words.h"
#include "settings/files/named_files.h"
#include "settings/path_options.h"

#include <memory>

namespace gnomon::app {

namespace {

/// Returns a camera path through the cameras that the source of a model or a glTF file contains. Throws Error if there
/// is none.
path::CameraPath sourcePath(const std::string& file, const std::string& sourceRoot) {
    const std::string suffix = read::loweredSuffix(file);
    const std::vector<Camera> cameras =
        suffix == ".gltf" || suffix == ".glb"
            ? read::openMeshSources({file}, gibibytes(2), {}, read::Textures::Off, sourceRoot)->summary().cameras
            : hierarchy::camerasOf(hierarchy::ModelFile(file));
    if (cameras.empty())
        throw Error(file, "the source of the model has no camera", "a glTF whose scene has a camera", "none");
    return path::pathThrough(cameras);
}

} // namespace

void addPathCommand(CLI::App& program) {
    struct Options {
        std::string model;
        settings::PathOptions path;
        std::string output;
        std::string sourceRoot;
        CommonOptions common;
    };

    CLI::App* command =
        program.add_subcommand("path", "Compute a camera path for a model: a walk, an orbit or a flight");
    auto options = std::make_shared<Options>();
    addModel(*command, options->model);
    command->add_option("--kind", options->path.kind, "Path: walk, orbit, flyby, approach or source (its cameras)")
        ->required()
        ->type_name("KIND|walk|orbit|flyby|approach|source");
    command->add_option("-o,--output", options->output, "Camera path to write")->required()->type_name("PATH.json");
    command->add_option("--storey", options->path.walk.storey, "Only storey of a walk; 0 is the lowest storey")
        ->type_name("N")
        ->default_str("all storeys");
    command
        ->add_option("--eye-height", options->path.walk.eyeHeight, "Height of the eye in a walk, in units of the model")
        ->type_name("H")
        ->default_str("1.7 m");
    command
        ->add_option("--source-root", options->sourceRoot, "Folder that textures and buffers of a glTF may come from")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->default_str("the folder of the glTF");
    command->footer(
        "A walk follows floors through rooms, doors and stairs at 1.4 m/s, for at most one minute. Around a\n"
        "model without floors it walks on the ground. The other paths take 12 s. `source` writes the cameras\n"
        "of a glTF, one second apart.");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        settings::checkPathOptions(options->path);
        const ThreadLimit limit(options->common);
        settings::requireDistinctFiles({{"MODEL", options->model}}, {{"--output", options->output}});
        const auto progress = makeProgress(options->common, Polling::No);
        progress->stage("path", "paths", 1);
        const path::CameraPath found =
            options->path.kind == "source"
                ? sourcePath(options->model, options->sourceRoot)
                : path::suitedPath(hierarchy::ModelFile(options->model), options->path.kind, options->path.walk);
        writeTextFile(options->output, path::toJson(found));
        progress->advance(1);
    });
}

} // namespace gnomon::app
