// `gnomon info`: what a model file says of itself, without reading a page.

#include "app/commands.h"
#include "core/printable.h"
#include "core/units.h"
#include "hierarchy/model_file.h"
#include "telemetry/json_text.h"

#include <algorithm>
#include <cmath>
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
    json["format_version"] = hierarchy::kFormatVersion;
    json["source_triangles"] = summary.sourceTriangles;
    json["source_vertices"] = summary.sourceVertices;
    json["dropped"] = summary.dropped;
    json["levels"] = ordered_json::array();
    for (const hierarchy::LevelInfo& level : summary.levels)
        json["levels"].push_back(
            {{"triangles", level.triangles},
             {"clusters", level.clusters},
             {"groups", level.groups},
             {"max_error", level.maxError}});
    json["coarsest_triangles"] = summary.coarsestTriangles;
    json["bounds"] = {{"min", vectorJson(summary.bounds.min)}, {"max", vectorJson(summary.bounds.max)}};
    json["grid_step"] = summary.grid.step();
    json["has_normals"] = summary.hasNormals;
    json["has_colors"] = summary.hasColors;
    json["pages"] = file.pages().size();
    json["file_bytes"] = file.fileBytes();
    json["content_hash"] = file.contentHash();
    json["options"] = summary.options;
    return json;
}

/// The digits that tell apart two coordinates of `summary` that are a step of its grid from each other; six at least.
int coordinateDigits(const hierarchy::ModelSummary& summary) {
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        largest = std::max({largest, std::abs(summary.bounds.min[i]), std::abs(summary.bounds.max[i])});
    const double digits = std::ceil(std::log10(std::max(1.0, largest / summary.grid.step()))) + 1;
    return static_cast<int>(std::clamp(digits, 6.0, 17.0)); // 17 tell any two doubles apart
}

void printInfo(const hierarchy::ModelFile& file) {
    const hierarchy::ModelSummary& summary = file.summary();
    const auto number = [](std::uint64_t value) { return static_cast<unsigned long long>(value); };
    std::printf(
        "%s: format %u, %s\n", printable(file.path()).c_str(), hierarchy::kFormatVersion, file.contentHash().c_str());
    std::printf(
        "source     %llu triangles, %llu vertices", number(summary.sourceTriangles), number(summary.sourceVertices));
    for (const auto& [reason, count] : summary.dropped)
        if (count > 0) std::printf(", %llu %s", number(count), printable(reason).c_str());
    const glm::dvec3& min = summary.bounds.min;
    const glm::dvec3& max = summary.bounds.max;
    const int digits = coordinateDigits(summary);
    std::printf("\nbounds     %.*g,%.*g,%.*g", digits, min.x, digits, min.y, digits, min.z);
    std::printf(" to %.*g,%.*g,%.*g", digits, max.x, digits, max.y, digits, max.z);
    std::printf("\ngrid step  %g", summary.grid.step());
    std::printf(
        "\nfile       %s in %zu pages, %.2f bytes a source triangle%s%s\n",
        readableBytes({file.fileBytes()}).c_str(),
        file.pages().size(),
        static_cast<double>(file.fileBytes()) /
            static_cast<double>(std::max<std::uint64_t>(summary.sourceTriangles, 1)),
        summary.hasNormals ? ", normals" : "",
        summary.hasColors ? ", colours" : "");
    std::printf("%-8s %12s %10s %8s  %s\n", "level", "triangles", "clusters", "groups", "largest error");
    for (std::size_t i = 0; i < summary.levels.size(); ++i) {
        const hierarchy::LevelInfo& level = summary.levels[i];
        std::printf(
            "%-8zu %12llu %10llu %8llu  %g\n",
            i,
            number(level.triangles),
            number(level.clusters),
            number(level.groups),
            level.maxError);
    }
    std::printf("coarsest %12llu\n", number(summary.coarsestTriangles));
    for (const auto& [name, value] : summary.options)
        std::printf("option   %s %s\n", printable(name).c_str(), printable(value).c_str());
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
            printInfo(file);
    });
}

} // namespace gnomon::app
