#include "preprocess/pipeline/report_text.h"

#include "core/formatted.h"
#include "core/printable.h"
#include "core/units.h"
#include "hierarchy/model_text.h"

namespace gnomon::pipeline {

namespace {

std::string pointText(const glm::dvec3& point) {
    return "(" + formatted("%.9g", point.x) + ", " + formatted("%.9g", point.y) + ", " + formatted("%.9g", point.z) +
           ")";
}

} // namespace

std::map<std::string, std::uint64_t> attributesDropped(const BuildReport& report, const read::MeshSummary& source) {
    std::map<std::string, std::uint64_t> counts = source.attributesDropped;
    if (report.badNormals > 0) counts[read::kBadNormals] += report.badNormals;
    return counts;
}

std::string reportText(
    const BuildReport& report,
    const read::MeshSummary& source,
    std::uint64_t peakResidentBytes,
    const std::string& howToTurn) {
    const hierarchy::ModelSummary& model = report.summary;
    const auto triangles = static_cast<double>(model.sourceTriangles);
    std::string text = readableCount(model.sourceTriangles) + " triangles in " + std::to_string(model.levels.size()) +
                       " levels, " + readableBytes({report.fileBytes}) + ", " +
                       formatted("%.1f", static_cast<double>(report.fileBytes) / triangles) +
                       " bytes a triangle, coarsest " + std::to_string(model.coarsestTriangles) + "\n";
    for (const auto& [reason, count] : model.dropped)
        if (count > 0) text += "dropped: " + reason + " " + std::to_string(count) + "\n";
    for (const auto& [name, count] : attributesDropped(report, source))
        text += "not kept: " + printable(name) + " (" + std::to_string(count) + ")\n";
    if (!source.cameras.empty())
        text += "cameras: " + std::to_string(source.cameras.size()) +
                ", which the command path writes to a file (kind source)\n";
    if (source.texelsPerEdge)
        text += "textures: their colours at vertices, " + formatted("%.1f", *source.texelsPerEdge) +
                " texels apart; what is between them is lost\n";
    text += "up " + hierarchy::upText(model);
    const bool isGiven = upConfidenceOf(model) == hierarchy::UpConfidence::Told;
    text += (isGiven ? "" : "; " + howToTurn) + "\n";
    const double rate = report.seconds > 0 ? triangles / report.seconds : 0;
    return text + formatted("%.2f", report.seconds) + " s, " + readableCount(static_cast<std::uint64_t>(rate)) +
           " triangles/s, peak " + readableBytes({peakResidentBytes}) + "\n";
}

std::string warningOfCoarsest(const BuildReport& report) {
    // The coarsest level of an ordinary mesh of any size has fewer triangles than this.
    constexpr std::uint64_t kManyTriangles = 1000;
    constexpr double kManyIrreduciblePercent = 1;
    const std::uint64_t source = report.summary.sourceTriangles;
    const double irreduciblePercent =
        100 * static_cast<double>(report.irreducibleTriangles) / static_cast<double>(source);
    const std::uint64_t coarsest = report.summary.coarsestTriangles;
    if (coarsest <= kManyTriangles && irreduciblePercent <= kManyIrreduciblePercent) return "";
    return "the coarsest level has " + std::to_string(coarsest) + " of " + std::to_string(source) +
           " triangles, expected at most " + std::to_string(kManyTriangles) + "; stuck are " +
           formatted("%.3g", irreduciblePercent) + " percent, expected at most " +
           formatted("%g", kManyIrreduciblePercent);
}

std::string warningOfStrays(const BuildReport& report) {
    const auto outside = report.summary.dropped.find("beyond_grid");
    if (outside == report.summary.dropped.end() || outside->second == 0) return "";
    return std::to_string(outside->second) + (outside->second == 1 ? " triangle is" : " triangles are") +
           " left out: too far from the main part for the grid, with corners at " + pointText(report.strays.min) +
           " to " + pointText(report.strays.max);
}

std::string warningOfStep(const BuildReport& report) {
    constexpr double kMaxStep = 0.1; // max grid step as a multiple of the median edge length
    const double step = report.summary.grid.step();
    if (report.medianEdge == 0 || step <= kMaxStep * report.medianEdge) return "";
    return "small details collapse: the grid's step is " + formatted("%.3g", step) +
           ", expected at most a tenth of the median edge, " + formatted("%.3g", report.medianEdge);
}

} // namespace gnomon::pipeline
