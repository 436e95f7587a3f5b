#include "app/commands.h"
#include "app/named_files.h"
#include "app/thread_limit.h"
#include "core/file.h"
#include "path/suited_path.h"

#include <memory>

namespace gnomon::app {

void addPathCommand(CLI::App& program) {
    struct Options {
        std::string model;
        std::string kind = "orbit";
        std::string output;
        CommonOptions common;
    };

    CLI::App* command = program.add_subcommand("path", "Find a camera path that suits a model");
    auto options = std::make_shared<Options>();
    command->add_option("MODEL", options->model, "A .gnm file")->required();
    command->add_option("--kind", options->kind, "walk is at eye height, with a high depth range")
        ->check(CLI::IsMember({"walk", "orbit", "flyby", "approach"}))
        ->required();
    command->add_option("-o,--output", options->output, "The path, JSON")->required();
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit limit(options->common);
        requireApart({{"MODEL", options->model}}, {{"--output", options->output}});
        const hierarchy::ModelFile model(options->model);
        writeTextFile(options->output, path::toJson(path::suitedPath(model, options->kind)));
    });
}

} // namespace gnomon::app
