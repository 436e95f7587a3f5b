// `gnomon info`: what a model file says of itself, without reading a page.

#include "app/commands.h"
#include "hierarchy/model_text.h"
#include "telemetry/json_text.h"

#include <cstdio>
#include <memory>

#include <nlohmann/json.hpp>

namespace gnomon::app {

namespace {

using nlohmann::ordered_json;

ordered_json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

ordered_json infoJson(const hierarchy::ModelFile& file) {
    const hierarchy::ModelSummary& summary = file.summary();
    ordered_json json;
    json["format_version"] = file.formatVersion();
    json["source_triangles"] = summary.sourceTriangles;
    json["source_vertices"] = summary.sourceVertices;
    json["dropped"] = summary.dropped;
    json["levels"] = ordered_json::array();
    for (const hierarchy::LevelInfo& level : summary.levels)
        json["levels"].push_back(
            {{"triangles", level.triangles},
             {"clusters", level.clusters},
             {"groups", level.groups},
             {"max_error", level.maxError},
             {"max_attribute_error", level.maxAttributeError}});
    json["coarsest_triangles"] = summary.coarsestTriangles;
    json["bounds"] = {{"min", vectorJson(summary.bounds.min)}, {"max", vectorJson(summary.bounds.max)}};
    json["grid_step"] = summary.grid.step();
    json["has_normals"] = summary.hasNormals;
    json["has_colors"] = summary.hasColors;
    json["attribute_error"] = summary.attributeError();
    json["fields"] = ordered_json::array();
    for (const hierarchy::Field& field : summary.fields)
        json["fields"].push_back(
            {{"name", field.name},
             {"min", field.least},
             {"max", field.greatest},
             {"bits", field.bits},
             {"error", field.error()}});
    json["up"] = hierarchy::upAxisText(summary.up);
    json["unit"] = hierarchy::rowOf(summary.unit).name;
    json["pages"] = file.pages().size();
    json["file_bytes"] = file.fileBytes();
    json["content_hash"] = file.contentHash();
    json["options"] = summary.options;
    return json;
}

} // namespace

void addInfoCommand(CLI::App& program) {
    struct Options {
        std::string model;
        bool json = false;
        CommonOptions common;
    };

    auto options = std::make_shared<Options>();
    CLI::App* command = program.add_subcommand("info", "Show what a model holds: levels, errors, bounds, size, hash");
    command->add_option("MODEL", options->model, "A .gnm file")->required();
    command->add_flag("--json", options->json, "Print one JSON document");
    addCommonOptions(*command, options->common);
    command->callback([options] {
        const hierarchy::ModelFile file(options->model);
        if (options->json)
            std::printf("%s\n", telemetry::jsonText(infoJson(file), 1).c_str());
        else
            std::fputs(hierarchy::modelText(file).c_str(), stdout);
    });
}

} // namespace gnomon::app
