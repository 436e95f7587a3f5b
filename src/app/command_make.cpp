// The command `gnomon make`, which generates test models of any size from a seed and writes them as a stream.

#include "app/command_line.h"
#include "app/commands.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/units.h"
#include "preprocess/make/model_file.h"
#include "preprocess/make/named_model.h"
#include "settings/files/named_files.h"
#include "settings/usage_error.h"

#include <cstdio>
#include <memory>
#include <string>

namespace gnomon::app {

namespace {

struct MakeOptions {
    std::string kind;
    std::string output;
    std::string triangles;
    std::uint64_t seed = 1;
    CommonOptions common;
};

std::unique_ptr<make::MadeModel> modelOf(const MakeOptions& options, std::uint64_t triangles) {
    try {
        return make::makeNamedModel(options.kind, triangles, options.seed);
    } catch (const Error& error) {
        throw settings::UsageError{"", error.what()}; // all values of the model come from options
    }
}

void runMake(const MakeOptions& options) {
    settings::requireExtension("--output", options.output, ".ply");
    std::uint64_t triangles = make::defaultTriangles(options.kind);
    if (!options.triangles.empty()) {
        const auto count = parseCount(options.triangles);
        if (!count)
            throw settings::UsageError{
                "--triangles",
                "--triangles: expected a count such as 250000, 13M or 1G, found '" + options.triangles + "'"};
        triangles = *count;
    }
    const auto progress = makeProgress(options.common);
    const auto model = modelOf(options, triangles);
    const std::string comment = "gnomon make " + options.kind + " --triangles " + std::to_string(triangles) +
                                " --seed " + std::to_string(options.seed);
    const auto size = make::writeMadeModel(*model, options.output, comment, options.common.threads, *progress);
    std::fprintf(
        stderr,
        "%s: %llu triangles, %llu vertices\n",
        printable(options.output).c_str(),
        static_cast<unsigned long long>(size.triangles),
        static_cast<unsigned long long>(size.vertices));
}

} // namespace

void addMakeCommand(CLI::App& program) {
    auto options = std::make_shared<MakeOptions>();
    CLI::App* command = program.add_subcommand("make", "Generate a test model of any size from a seed");
    command->add_option("KIND", options->kind, "statue (closed), plant (many parts) or planes (15 aeroplanes)")
        ->required()
        ->check(CLI::IsMember(make::modelNames()));
    command->add_option("-o,--output", options->output, "PLY to write")->required()->type_name("FILE.ply");
    command->add_option("--triangles", options->triangles, "Triangles within 2%, such as 13M")
        ->type_name("N")
        ->default_str("1M; planes 275k");
    command->add_option("--seed", options->seed, "Seed of the model")
        ->check(seedText())
        ->type_name("S")
        ->capture_default_str();
    addCommonOptions(*command, options->common);
    command->callback([options] { runMake(*options); });
}

} // namespace gnomon::app
