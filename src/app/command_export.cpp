// The command `gnomon export`, which writes a uniform cut of a model as PLY or glTF, or the whole model as 3D Tiles.

#include "app/commands.h"
#include "app/thread_limit.h"
#include "core/printable.h"
#include "core/units.h"
#include "preprocess/exporter/export.h"
#include "preprocess/exporter/tiles/tileset.h"
#include "settings/codec.h"
#include "settings/files/named_files.h"

#include <cstdio>
#include <memory>

namespace gnomon::app {

namespace {

struct ExportOptions {
    std::string model;
    std::string output;
    std::string format;
    std::string place;
    bool isUncompressed = false;
    std::string memory = "2G";
    std::string triangles;
    std::string error;
    CommonOptions common;
};

exporter::ExportLimit limitOf(const ExportOptions& options) {
    exporter::ExportLimit limit;
    limit.memory = *parseBytes(options.memory);
    if (options.triangles.empty() == options.error.empty())
        throw settings::UsageError{"--triangles", "export: say either --triangles or --error"};
    if (!options.triangles.empty()) {
        limit.triangles = parseCount(options.triangles);
        if (!limit.triangles)
            throw settings::UsageError{
                "--triangles", "--triangles: not a count: " + options.triangles + " (write 250000, 13M or 1G)"};
    }
    if (!options.error.empty()) {
        const auto length = settings::number("a length of at least 0", [](double value) { return value >= 0; });
        limit.error = settings::parsed(length, "--error", options.error);
    }
    return limit;
}

void runTiles(const ExportOptions& options) {
    if (!options.triangles.empty() || !options.error.empty())
        throw settings::UsageError{
            "--format", "export: tiles have every level of detail: no --triangles and no --error"};
    exporter::TilesetOptions tiles;
    tiles.memory = *parseBytes(options.memory);
    tiles.isPacked = !options.isUncompressed;
    if (!options.place.empty()) tiles.place = settings::parsed(settings::vector(), "--ecef", options.place);
    const auto progress = makeProgress(options.common);
    const auto done = exporter::exportTileset(options.model, tiles, options.output, *progress);
    std::fprintf(stderr, "%s: %s\n", printable(options.output).c_str(), exporter::tilesetText(done).c_str());
}

void runCut(const ExportOptions& options) {
    const exporter::ExportLimit limit = limitOf(options);
    settings::requireApart({{"MODEL", options.model}}, {{"--output", options.output}});
    const bool isGlb = options.format.empty() ? options.output.ends_with(".glb") : options.format == "glb";
    settings::requireExtension("--output", options.output, isGlb ? ".glb" : ".ply");
    const auto progress = makeProgress(options.common);
    const auto cut = exporter::exportCut(
        options.model,
        limit,
        options.output,
        *progress,
        isGlb ? exporter::ExportFormat::Glb : exporter::ExportFormat::Ply);
    std::fprintf(stderr, "%s: %s\n", printable(options.output).c_str(), exporter::cutText(cut).c_str());
}

} // namespace

void addExportCommand(CLI::App& program) {
    auto options = std::make_shared<ExportOptions>();
    CLI::App* command = program.add_subcommand(
        "export", "Write one uniform level of detail as a PLY or a glTF, or all of them as 3D Tiles");
    addModel(*command, options->model);
    command->add_option("-o,--output", options->output, "The .ply or .glb to write, or the folder of tiles")
        ->required();
    command->add_option("--format", options->format, "ply, glb or 3dtiles; without it by the name of the output")
        ->check(CLI::IsMember({"ply", "glb", "3dtiles"}));
    command->add_option("--ecef", options->place, "Of 3D Tiles: where on the earth the model stands, LAT,LON,HEIGHT");
    command->add_flag("--uncompressed", options->isUncompressed, "Of 3D Tiles: without EXT_meshopt_compression");
    command->add_option("--memory", options->memory, "Peak resident size of the process")
        ->check(memorySize())
        ->capture_default_str();
    auto* triangles = command->add_option("--triangles", options->triangles, "At most so many; 13M is a count too");
    command->add_option("--error", options->error, "Error of at most so many world units; 0 is full detail")
        ->excludes(triangles);
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit threads(options->common);
        options->format == "3dtiles" ? runTiles(*options) : runCut(*options);
    });
}

} // namespace gnomon::app
