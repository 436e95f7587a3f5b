#include "api/gnomon.h"
#include "api/plain_errors.h"
#include "api/watched.h"
#include "core/process/floating_point.h"
#include "core/units.h"
#include "preprocess/pipeline/build_model.h"
#include "preprocess/pipeline/fingerprint.h"
#include "preprocess/pipeline/report_json.h"
#include "preprocess/pipeline/source_up.h"
#include "preprocess/read/open_mesh_sources.h"
#include "settings/codec.h"
#include "settings/files/named_files.h"
#include "telemetry/json_text.h"
#include "telemetry/process_clock.h"

namespace gnomon::api {

namespace {

pipeline::BuildOptions buildOptionsOf(
    const std::vector<std::string>& inputs, const std::string& output, const BuildOptions& asked) {
    std::vector<settings::NamedFile> named;
    named.reserve(inputs.size());
    for (const std::string& input : inputs)
        named.push_back({"an input", input});
    settings::requireDistinctFiles(named, {{"the output", output}});
    settings::requireExtension("the output", output, ".gnm");
    const auto unit = hierarchy::unitNamed(asked.unit);
    if (!unit) throw Error("unit", "unknown unit", "m, cm, mm, ft or in", asked.unit);
    pipeline::BuildOptions options;
    options.output = output;
    options.memory = {asked.memory};
    options.threads = asked.threads;
    options.temporaryFolder = asked.temporaryFolder;
    options.fields = asked.fields;
    options.inputKey = pipeline::fingerprintOf(inputs);
    options.unit = *unit;
    const glm::dvec3 up = settings::parsed(settings::upDirection(), "up", asked.up);
    if (up != settings::kAutoUp)
        options.up = hierarchy::UpAxis{glm::normalize(up)};
    else
        pipeline::askForUpOfSources(options, inputs);
    return options;
}

} // namespace

std::string version() {
    return GNOMON_VERSION;
}

std::string build(
    const std::vector<std::string>& inputs,
    const std::string& output,
    const BuildOptions& options,
    const OnProgress& onProgress) {
    requireUsualFloatingPoint();
    if (inputs.empty()) throw Error("build", "no input files", "at least one mesh", "none");
    const pipeline::BuildOptions asked = withPlainErrors([&] { return buildOptionsOf(inputs, output, options); });
    const auto source =
        read::openMeshSources(inputs, asked.memory, asked.fields, read::Textures::Bake, options.sourceRoot);
    Watched progress(onProgress);
    const pipeline::BuildReport report = pipeline::buildModel(*source, asked, progress);
    return telemetry::jsonText(pipeline::reportJson(report, source->summary(), telemetry::peakResident().count), 1);
}

} // namespace gnomon::api
