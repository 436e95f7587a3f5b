// The command `gnomon export`. It writes a model as a mesh (PLY or glTF) with the same error everywhere, or the whole
// model as 3D Tiles.

#include "app/commands.h"
#include "app/thread_limit.h"
#include "core/printable.h"
#include "core/units.h"
#include "preprocess/exporter/export.h"
#include "preprocess/exporter/tiles/tileset.h"
#include "settings/codec.h"
#include "settings/files/named_files.h"
#include "settings/old_names.h"

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
        throw settings::UsageError{"--triangles", "export needs either --triangles N or --error E"};
    if (!options.triangles.empty()) {
        limit.triangles = parseCount(options.triangles);
        if (!limit.triangles)
            throw settings::UsageError{
                "--triangles",
                "--triangles: expected a count such as 250000, 13M or 1G, found '" + options.triangles + "'"};
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
            "--format", "--format 3dtiles writes all levels of detail; remove --triangles and --error"};
    exporter::TilesetOptions tiles;
    tiles.memory = *parseBytes(options.memory);
    tiles.isPacked = !options.isUncompressed;
    if (!options.place.empty()) tiles.place = settings::parsed(settings::vector(), "--geodetic", options.place);
    const auto progress = makeProgress(options.common);
    const auto done = exporter::exportTileset(options.model, tiles, options.output, *progress);
    std::fprintf(stderr, "%s: %s\n", printable(options.output).c_str(), exporter::tilesetText(done).c_str());
}

void runCut(const ExportOptions& options) {
    const exporter::ExportLimit limit = limitOf(options);
    settings::requireDistinctFiles({{"MODEL", options.model}}, {{"--output", options.output}});
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
    CLI::App* command =
        program.add_subcommand("export", "Write a model as a PLY or glTF of one level of detail, or as 3D Tiles");
    addModel(*command, options->model);
    command->add_option("-o,--output", options->output, "PLY or GLB to write, or the folder of the tiles")
        ->required()
        ->type_name("OUT");
    command->add_option("--format", options->format, "Format: ply, glb or 3dtiles")
        ->check(CLI::IsMember({"ply", "glb", "3dtiles"}))
        ->type_name("FORMAT")
        ->default_str("from the name of OUT");
    command
        ->add_option(
            settings::withOldNames("--geodetic"),
            options->place,
            "Position of 3D Tiles (WGS84): degrees, degrees, metres")
        ->type_name("LAT,LON,HEIGHT");
    command->add_flag("--uncompressed", options->isUncompressed, "3D Tiles without EXT_meshopt_compression");
    command->add_option("--memory", options->memory, "Max resident memory of the process")
        ->check(memorySize())
        ->type_name("SIZE")
        ->capture_default_str();
    auto* triangles =
        command->add_option("--triangles", options->triangles, "Max number of triangles, such as 250k or 13M");
    triangles->type_name("N");
    command->add_option("--error", options->error, "Max geometric error in units of the model; 0 is full detail")
        ->excludes(triangles)
        ->type_name("E");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const ThreadLimit threads(options->common);
        options->format == "3dtiles" ? runTiles(*options) : runCut(*options);
    });
}

} // namespace gnomon::app
