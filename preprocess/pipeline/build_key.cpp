#include "preprocess/pipeline/build_key.h"

#include "hierarchy/model.h"
#include "preprocess/pipeline/checkpoint_log.h"

namespace gnomon::pipeline {

namespace {

const char* nameOf(simplify::Simplifier simplifier) {
    switch (simplifier) {
    case simplify::Simplifier::Meshopt:
        return "meshopt";
    case simplify::Simplifier::OpenMesh:
        return "openmesh";
    case simplify::Simplifier::Quadric:
        break;
    }
    return "own";
}

} // namespace

std::map<std::string, std::string> optionsOf(const BuildOptions& options) {
    std::map<std::string, std::string> rows{
        {"chunk_triangles", std::to_string(options.chunkTriangles)},
        {"cluster_triangles", std::to_string(options.level.clusterTriangles)},
        {"error", std::string(wordOf(levels::kErrorKinds, options.level.error))},
        {"simplifier", nameOf(options.level.simplifier)},
    };
    if (options.keepsStrays) rows["strays"] = "kept";
    std::string fields;
    for (const std::string& name : options.fields)
        fields += (fields.empty() ? "" : ",") + name;
    if (!fields.empty()) rows["fields"] = fields;
    return rows;
}

std::string keyOf(const BuildOptions& options) {
    std::string key =
        "format " + std::to_string(hierarchy::kFormatVersion) + ", checkpoints " + std::to_string(kCheckpointVersion);
    for (const auto& [name, value] : optionsOf(options))
        key.append(", ").append(name).append(" ").append(value);
    return key + ", " + options.inputKey;
}

} // namespace gnomon::pipeline
