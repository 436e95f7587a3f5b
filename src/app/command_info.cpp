// The command `gnomon info`, which prints the properties of a model. It reads no pages of geometry.

#include "app/commands.h"
#include "hierarchy/model_text.h"

#include <cstdio>
#include <memory>

namespace gnomon::app {

void addInfoCommand(CLI::App& program) {
    struct Options {
        std::string model;
        bool json = false;
        CommonOptions common;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("info", "Print the properties of a model: levels, errors, bounds, size, hash");
    addModel(*command, options->model);
    command->add_flag("--json", options->json, "Print one JSON document on stdout");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const hierarchy::ModelFile file(options->model);
        if (options->json)
            std::fputs(hierarchy::modelJson(file).c_str(), stdout);
        else
            std::fputs(hierarchy::modelText(file).c_str(), stdout);
    });
}

} // namespace gnomon::app
