#include "preprocess/pipeline/report_json.h"

#include <nlohmann/json.hpp>

namespace gnomon::pipeline {

nlohmann::ordered_json reportJson(
    const BuildReport& report, const read::MeshSummary& source, std::uint64_t peakResidentBytes) {
    std::uint64_t clusters = 0;
    std::uint64_t groups = 0;
    for (const hierarchy::LevelInfo& level : report.summary.levels) {
        clusters += level.clusters;
        groups += level.groups;
    }
    nlohmann::ordered_json phases = nlohmann::ordered_json::array();
    for (const BuildPhase& phase : report.phases)
        phases.push_back(
            {{"name", phase.name},
             {"seconds", phase.seconds},
             {"bytes_read", phase.bytesRead},
             {"bytes_written", phase.bytesWritten}});
    nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
    for (const auto& [nodes, roundTriangles, locked, before] : report.rounds)
        rounds.push_back(
            {{"nodes", nodes}, {"triangles", roundTriangles}, {"locked", locked}, {"locked_before", before}});
    const auto triangles = static_cast<double>(report.summary.sourceTriangles);
    return {
        {"source_triangles", report.summary.sourceTriangles},
        {"source_vertices", report.summary.sourceVertices},
        {"dropped", report.summary.dropped},
        {"attributes_dropped", source.attributesDropped},
        {"texels_per_edge",
         source.texelsPerEdge ? nlohmann::ordered_json(*source.texelsPerEdge) : nlohmann::ordered_json()},
        {"fields", source.fields},
        {"clusters", clusters},
        {"groups", groups},
        {"level_count", report.summary.levels.size()},
        {"pages", report.pages},
        {"coarsest_triangles", report.summary.coarsestTriangles},
        {"stuck_triangles", report.stuckTriangles},
        {"file_bytes", report.fileBytes},
        {"bytes_per_source_triangle", static_cast<double>(report.fileBytes) / triangles},
        {"peak_rss_bytes", peakResidentBytes},
        {"temporary_bytes", report.temporaryBytes},
        {"seconds", report.seconds},
        {"phases", phases},
        {"rounds", rounds},
        {"triangles_per_second", report.seconds > 0 ? triangles / report.seconds : 0},
        {"content_hash", report.contentHash},
        {"up", hierarchy::upAxisText(report.summary.up)},
        {"up_because", report.upBecause},
        {"unit", hierarchy::rowOf(report.summary.unit).name},
    };
}

} // namespace gnomon::pipeline
