#include "app/commands.h"
#include "app/thread_limit.h"
#include "core/file.h"
#include "path/suited_path.h"
#include "settings/files/named_files.h"
#include "settings/path_options.h"

#include <memory>

namespace gnomon::app {

void addPathCommand(CLI::App& program) {
    struct Options {
        std::string model;
        settings::PathOptions path;
        std::string output;
        CommonOptions common;
    };

    CLI::App* command = program.add_subcommand("path", "Find a camera path that suits a model");
    auto options = std::make_shared<Options>();
    addModel(*command, options->model);
    command->add_option("--kind", options->path.kind, settings::kPathKindHelp)->required();
    command->add_option("-o,--output", options->output, "The path, JSON")->required();
    command->add_option("--storey", options->path.walk.storey, "Of a walk: only there; 0 is the lowest");
    command->add_option("--eye-height", options->path.walk.eyeHeight, "Of a walk; 1.7 where metres fit the model");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        settings::checkPathOptions(options->path);
        const ThreadLimit limit(options->common);
        settings::requireApart({{"MODEL", options->model}}, {{"--output", options->output}});
        const hierarchy::ModelFile model(options->model);
        const auto progress = makeProgress(options->common, Polling::No);
        progress->stage("path", "paths", 1);
        writeTextFile(options->output, path::toJson(path::suitedPath(model, options->path.kind, options->path.walk)));
        progress->advance(1);
    });
}

} // namespace gnomon::app
