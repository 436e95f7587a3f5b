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

/// Returns the cameras of the source of a model, or of a glTF. Throws Error if there is none.
path::CameraPath sourcePath(const std::string& file, const std::string& sourceRoot) {
    const std::string suffix = read::loweredSuffix(file);
    const std::vector<Camera> cameras =
        suffix == ".gltf" || suffix == ".glb"
            ? read::openMeshSources({file}, gibibytes(2), {}, read::Textures::Off, sourceRoot)->summary().cameras
            : hierarchy::camerasOf(hierarchy::ModelFile(file));
    if (cameras.empty())
        throw Error(file, "no camera of its source can be used", "a glTF with a camera in its scene", "none");
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

    CLI::App* command = program.add_subcommand("path", "Find a camera path that suits a model");
    auto options = std::make_shared<Options>();
    addModel(*command, options->model);
    command->add_option("--kind", options->path.kind, settings::kPathKindHelp)->required();
    command->add_option("-o,--output", options->output, "The path, JSON")->required();
    command->add_option("--storey", options->path.walk.storey, "Of a walk: only there; 0 is the lowest");
    command->add_option("--eye-height", options->path.walk.eyeHeight, "Of a walk; 1.7 where metres fit the model");
    command
        ->add_option(
            "--source-root",
            options->sourceRoot,
            "Folder that files of a glTF may come from (default: the folder of the glTF)")
        ->check(CLI::ExistingDirectory);
    addCommonOptions(*command, options->common);
    command->callback([options] {
        settings::checkPathOptions(options->path);
        const ThreadLimit limit(options->common);
        settings::requireApart({{"MODEL", options->model}}, {{"--output", options->output}});
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
