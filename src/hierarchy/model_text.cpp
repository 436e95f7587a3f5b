#include "hierarchy/model_text.h"

#include "core/printable.h"
#include "core/units.h"
#include "hierarchy/source_cameras.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include <nlohmann/json.hpp>

namespace gnomon::hierarchy {

namespace {

using nlohmann::ordered_json;

ordered_json vectorJson(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// Returns how many decimal digits distinguish coordinates that are one grid step apart, at least six.
int coordinateDigits(const ModelSummary& summary) {
    double largest = 0;
    for (int i = 0; i < 3; ++i)
        largest = std::max({largest, std::abs(summary.bounds.min[i]), std::abs(summary.bounds.max[i])});
    const double digits = std::ceil(std::log10(std::max(1.0, largest / summary.grid.step()))) + 1;
    return static_cast<int>(std::clamp(digits, 6.0, 17.0)); // 17 digits distinguish any two doubles
}

void putVector(std::ostream& out, const glm::dvec3& v) {
    out << v.x << ',' << v.y << ',' << v.z;
}

/// Returns the build options of the model without the cameras. The model stores cameras among its options, but they are
/// no options and are too long to print.
std::map<std::string, std::string> optionsWithoutCameras(const ModelSummary& summary) {
    std::map<std::string, std::string> options = summary.options;
    options.erase(kCamerasOption);
    return options;
}

void putSource(std::ostream& out, const ModelSummary& summary) {
    out << "source     " << summary.sourceTriangles << " triangles, " << summary.sourceVertices << " vertices";
    for (const auto& [reason, count] : summary.dropped)
        if (count > 0) out << ", " << count << ' ' << printable(reason);
    out << "\nbounds     " << std::setprecision(coordinateDigits(summary));
    putVector(out, summary.bounds.min);
    out << " to ";
    putVector(out, summary.bounds.max);
    out << std::setprecision(6) << "\naxes       up " << upText(summary) << "; in " << rowOf(summary.unit).name;
    for (const Field& field : summary.fields)
        out << "\nfield      " << printable(field.name) << ' ' << field.min << " to " << field.max << " in "
            << field.bits << " bits";
    out << "\ngrid step  " << summary.grid.step() << '\n';
}

void putLevels(std::ostream& out, const ModelSummary& summary) {
    const auto row = [&out](const auto& level, auto triangles, auto clusters, auto groups) -> std::ostream& {
        return out << std::left << std::setw(8) << level << std::right << ' ' << std::setw(12) << triangles << ' '
                   << std::setw(10) << clusters << ' ' << std::setw(8) << groups << "  ";
    };
    const bool hasAttributes = summary.attributeError() > 0;
    row("level", "triangles", "clusters", "groups")
        << "largest error" << (hasAttributes ? "  of attributes" : "") << '\n';
    for (std::size_t i = 0; i < summary.levels.size(); ++i) {
        const LevelInfo& level = summary.levels[i];
        row(i, level.triangles, level.clusters, level.groups);
        if (hasAttributes)
            out << std::left << std::setw(15) << level.maxError << std::right << level.maxAttributeError << '\n';
        else
            out << level.maxError << '\n';
    }
    out << "coarsest " << std::setw(12) << summary.coarsestTriangles << '\n';
}

} // namespace

UpConfidence upConfidenceOf(const ModelSummary& summary) {
    if (const auto found = summary.options.find("up_confidence"); found != summary.options.end())
        return valueOf(kUpConfidences, found->second).value_or(UpConfidence::Guess);
    const auto because = summary.options.find("up"); // older builds have written this option
    const bool isGiven = because != summary.options.end() && !because->second.starts_with("guessed");
    return isGiven ? UpConfidence::Told : UpConfidence::Guess;
}

std::string upText(const ModelSummary& summary) {
    const auto because = summary.options.find("up");
    return upAxisText(summary.up) + ", " + std::string(wordOf(kUpConfidences, upConfidenceOf(summary))) +
           (because == summary.options.end() ? "" : " " + printable(because->second));
}

std::string modelText(const ModelFile& file) {
    const ModelSummary& summary = file.summary();
    std::ostringstream out;
    out << printable(file.path()) << ": format " << file.formatVersion() << ", " << file.contentHash() << '\n';
    putSource(out, summary);
    const auto triangles = static_cast<double>(std::max<std::uint64_t>(summary.sourceTriangles, 1));
    out << "file       " << readableBytes({file.fileBytes()}) << " in " << file.pages().size() << " pages, "
        << std::fixed << std::setprecision(2) << static_cast<double>(file.fileBytes()) / triangles << std::defaultfloat
        << std::setprecision(6) << " bytes a source triangle" << (summary.hasNormals ? ", normals" : "")
        << (summary.hasColors ? ", colours" : "") << '\n';
    putLevels(out, summary);
    if (const std::size_t cameras = cameraCount(summary); cameras > 0) out << "cameras    " << cameras << '\n';
    for (const auto& [name, value] : optionsWithoutCameras(summary))
        out << "option   " << printable(name) << ' ' << printable(value) << '\n';
    return out.str();
}

std::string modelJson(const ModelFile& file) {
    const ModelSummary& summary = file.summary();
    ordered_json json;
    json["format_version"] = file.formatVersion();
    json["source_triangles"] = summary.sourceTriangles;
    json["source_vertices"] = summary.sourceVertices;
    json["dropped"] = summary.dropped;
    json["levels"] = ordered_json::array();
    for (const LevelInfo& level : summary.levels)
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
    for (const Field& field : summary.fields)
        json["fields"].push_back(
            {{"name", field.name},
             {"min", field.min},
             {"max", field.max},
             {"bits", field.bits},
             {"error", field.error()}});
    json["up"] = upAxisText(summary.up);
    json["up_confidence"] = wordOf(kUpConfidences, upConfidenceOf(summary));
    json["unit"] = rowOf(summary.unit).name;
    json["pages"] = file.pages().size();
    json["file_bytes"] = file.fileBytes();
    json["content_hash"] = file.contentHash();
    json["cameras"] = cameraCount(summary);
    json["options"] = optionsWithoutCameras(summary);
    return json.dump(1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

} // namespace gnomon::hierarchy
