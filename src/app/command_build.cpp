#include "app/commands.h"
#include "app/console.h"
#include "core/error.h"
#include "core/printable.h"
#include "core/units.h"
#include "preprocess/pipeline/fingerprint.h"
#include "preprocess/pipeline/report_json.h"
#include "preprocess/pipeline/report_text.h"
#include "preprocess/pipeline/source_up.h"
#include "preprocess/read/open_mesh_sources.h"
#include "settings/codec.h"
#include "settings/files/named_files.h"
#include "telemetry/json_text.h"
#include "telemetry/process_clock.h"

#include <cstdio>
#include <map>

namespace gnomon::app {

namespace {

using pipeline::BuildReport;
using simplify::Simplifier;

struct BuildCommand {
    CommonOptions common;
    std::vector<std::string> inputs;
    std::vector<std::string> fields;
    std::string up = "auto";
    std::string unit = "m";
    std::string textures = "bake";
    std::string sourceRoot;
    std::string output;
    std::string memory = "2G";
    std::string temporary;
    std::string scratchRate = "0";
    std::string simplifier = "quadric";
    std::string error = "measured";
    std::uint32_t clusterTriangles = 128;
    std::string chunkTriangles = std::to_string(pipeline::kChunkTriangles);
    double maxIrreduciblePercent = 100;
    bool isInMemory = false;
    bool isResumed = false;
    bool keepsStrays = false;
    bool isJson = false;
};

constexpr const char* kHowToTurn = "--up x, y, z, -x, -y, -z or X,Y,Z turns the model";

void printRemarks(const read::MeshSource& source) {
    for (const std::string& remark : source.summary().remarks)
        printMessage(remark);
}

std::optional<BuildReport> built(
    read::MeshSource& source,
    const pipeline::BuildOptions& options,
    const CommonOptions& common,
    const BuildBy& buildBy) {
    try {
        const auto progress = makeProgress(common);
        if (!buildBy) return buildModel(source, options, *progress);
        return buildBy(source, options, *progress);
    } catch (const Error&) {
        printRemarks(source); // because a remark can explain the error
        throw;
    }
}

/// Sets the up direction with which the model is built to `up`. For `auto`, uses the up direction that the inputs
/// declare, if any.
void takeUp(const glm::dvec3& up, const std::vector<std::string>& inputs, pipeline::BuildOptions& options) {
    if (up != settings::kAutoUp)
        options.up = hierarchy::UpAxis{glm::normalize(up)};
    else
        pipeline::askForUpOfSources(options, inputs);
}

void run(const BuildCommand& command, const BuildBy& buildBy) {
    const glm::dvec3 up = settings::parsed(settings::upDirection(), "--up", command.up);
    std::vector<settings::NamedFile> inputs;
    for (const std::string& input : command.inputs)
        inputs.push_back({"INPUT", input});
    settings::requireDistinctFiles(inputs, {{"--output", command.output}});
    settings::requireExtension("--output", command.output, ".gnm");
    pipeline::BuildOptions options;
    options.output = command.output;
    options.memory = *parseBytes(command.memory);
    options.threads = command.common.threads;
    options.level.clusterTriangles = command.clusterTriangles;
    options.level.error = *valueOf(levels::kErrorKinds, command.error);
    options.chunkTriangles = static_cast<std::uint32_t>(*parseCount(command.chunkTriangles));
    options.temporaryFolder = command.temporary;
    options.scratchBytesPerSecond = parseBytes(command.scratchRate)->count;
    options.isInMemory = command.isInMemory;
    options.isResumed = command.isResumed;
    options.onDamage = [](const std::string& damage) {
        printWarning(damage + "; the build starts again from the beginning");
    };
    options.onKeptFolder = printWarning;
    const std::map<std::string, Simplifier> simplifiers{
        {"quadric", Simplifier::Quadric},
        {"own", Simplifier::Quadric}, // earlier name, which models still contain
        {"meshopt", Simplifier::Meshopt},
        {"openmesh", Simplifier::OpenMesh}};
    options.level.simplifier = simplifiers.at(command.simplifier);
    if (command.maxIrreduciblePercent < 100) options.maxIrreduciblePercent = command.maxIrreduciblePercent;
    options.fields = command.fields;
    options.keepsStrays = command.keepsStrays;
    options.unit = *hierarchy::unitNamed(command.unit);
    takeUp(up, command.inputs, options);
    const auto textures = command.textures == "bake" ? read::Textures::Bake : read::Textures::Off;
    const auto source =
        read::openMeshSources(command.inputs, options.memory, command.fields, textures, command.sourceRoot);
    std::vector<std::string> read = command.inputs;
    read.insert(read.end(), source->summary().additionalFiles.begin(), source->summary().additionalFiles.end());
    options.inputKey = pipeline::fingerprintOf(read) + (command.textures == "bake" ? "" : ", textures off");
    const std::optional<BuildReport> done = built(*source, options, command.common, buildBy);
    if (!done) return;
    const BuildReport& report = *done;
    printRemarks(*source);
    const std::string strays = pipeline::warningOfStrays(report);
    for (const std::string& warning :
         {pipeline::warningOfCoarsest(report),
          strays.empty() ? strays : strays + "; --keep-strays includes such triangles, with a coarser grid",
          pipeline::warningOfStep(report)})
        if (!warning.empty()) printWarning(command.output + ": " + warning);
    if (command.isJson)
        std::printf(
            "%s\n",
            telemetry::jsonText(reportJson(report, source->summary(), telemetry::peakResident().count), 1).c_str());
    else
        std::printf(
            "%s: %s",
            printable(command.output).c_str(),
            pipeline::reportText(report, source->summary(), telemetry::peakResident().count, kHowToTurn).c_str());
    requirePrinted("the model " + command.output + " is complete");
}

CLI::Validator chunkSize() {
    return {
        [](std::string& text) {
            const auto triangles = parseCount(text);
            const bool isGood = triangles && *triangles >= 64 && *triangles <= (1U << 26U);
            return isGood ? std::string() : "expected a count from 64 to 64M such as 200k, found '" + text + "'";
        },
        "COUNT"};
}

/// Adds the options that change the cluster hierarchy of the model.
void addShapeOptions(CLI::App& command, BuildCommand& options) {
    command.add_option("--cluster-triangles", options.clusterTriangles, "Max triangles per cluster, from 8 to 256")
        ->check(CLI::Range(8, 256))
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option(
            "--chunk-triangles",
            options.chunkTriangles,
            "Max triangles per chunk, the part of a mesh that one thread builds")
        ->check(chunkSize())
        ->type_name("N")
        ->capture_default_str();
    command
        .add_option(
            "--simplifier",
            options.simplifier,
            "Simplifier: quadric (the simplifier of Gnomon; its old name is own), meshopt or openmesh")
        ->check(CLI::IsMember({"quadric", "meshopt", "openmesh", "own"}))
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option(
            "--error", options.error, "Stored errors: measured (bounds), tight (lower bounds) or estimated (no bounds)")
        ->check(CLI::IsMember({"measured", "tight", "estimated"}))
        ->type_name("KIND")
        ->capture_default_str();
}

} // namespace

void addBuildCommand(CLI::App& program, const BuildBy& buildBy) {
    auto options = std::make_shared<BuildCommand>();
    CLI::App* command = program.add_subcommand("build", "Convert a mesh to a model with levels of detail (.gnm)");
    command->add_option("INPUT", options->inputs, "Meshes: PLY, OBJ, STL, OFF or glTF; several inputs become one model")
        ->required();
    command->add_option("-o,--output", options->output, "Model to write")->required()->type_name("MODEL.gnm");
    command->add_option("--fields", options->fields, "Scalar vertex properties of a PLY to store, at most four")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->type_name("NAME,...");
    command->add_option("--textures", options->textures, "Textures: bake (their colours at vertices) or off")
        ->check(CLI::IsMember({"bake", "off"}))
        ->type_name("MODE")
        ->capture_default_str();
    command
        ->add_option(
            "--source-root", options->sourceRoot, "Folder that textures, buffers and material libraries may come from")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR")
        ->default_str("the folder of the source");
    command->add_option("--memory", options->memory, "Max resident memory of the process")
        ->check(memorySize())
        ->type_name("SIZE")
        ->capture_default_str();
    CLI::Option* folder = command->add_option("--tmp", options->temporary, "Folder for temporary files")
                              ->check(CLI::ExistingDirectory)
                              ->type_name("DIR")
                              ->default_str("the folder of MODEL.gnm");
    CLI::Option* resume = command->add_flag("--resume", options->isResumed, "Continue a build that was killed");
    command->add_flag("--in-memory", options->isInMemory, "Build without temporary files")
        ->excludes(folder)
        ->excludes(resume);
    addShapeOptions(*command, *options);
    command
        ->add_option(
            "--max-stuck", options->maxIrreduciblePercent, "Max percentage of triangles that no coarser level replaces")
        ->check(CLI::Range(0.0, 100.0))
        ->type_name("PERCENT")
        ->capture_default_str();
    command->add_option("--up", options->up, "Up direction: x, y, z, -x, -y, -z, X,Y,Z or auto")
        ->type_name("AXIS")
        ->capture_default_str();
    command->add_option("--unit", options->unit, "Unit of the coordinates: m, cm, mm, ft or in")
        ->check(CLI::IsMember({"m", "cm", "mm", "ft", "in"}))
        ->type_name("UNIT")
        ->capture_default_str();
    command->add_flag(
        "--keep-strays",
        options->keepsStrays,
        "Include triangles far outside the part with 99.9% of the triangles; the grid becomes coarser");
    command->add_option("--scratch-rate", options->scratchRate, "What a slower disk would do: bytes a second")
        ->check(memorySize())
        ->group(""); // for measurements only, so the help does not list it
    command->add_flag("--json", options->isJson, "Print one JSON document on stdout");
    addCommonOptions(*command, options->common);
    command->callback([options, buildBy] { run(*options, buildBy); });
}

} // namespace gnomon::app
