#include "preprocess/pipeline/report_json.h"

#include "preprocess/pipeline/report_text.h"

#include <nlohmann/json.hpp>

namespace gnomon::pipeline {

namespace {

nlohmann::ordered_json phasesJson(const BuildReport& report) {
    nlohmann::ordered_json phases = nlohmann::ordered_json::array();
    for (const BuildPhase& phase : report.phases) {
        phases.push_back(
            {{"name", phase.name},
             {"seconds", phase.seconds},
             {"bytes_read", phase.bytesRead},
             {"bytes_written", phase.bytesWritten}});
        if (report.processes.empty()) continue;
        phases.back()["tasks"] = phase.team.tasks;
        phases.back()["idle_share"] = phase.team.idle;
        phases.back()["slowest_rank"] = phase.team.slowest;
    }
    return phases;
}

} // namespace

nlohmann::ordered_json reportJson(
    const BuildReport& report, const read::MeshSummary& source, std::uint64_t peakResidentBytes) {
    std::uint64_t clusters = 0;
    std::uint64_t groups = 0;
    for (const hierarchy::LevelInfo& level : report.summary.levels) {
        clusters += level.clusters;
        groups += level.groups;
    }
    nlohmann::ordered_json rounds = nlohmann::ordered_json::array();
    for (const auto& [nodes, roundTriangles, locked, before] : report.rounds)
        rounds.push_back(
            {{"nodes", nodes}, {"triangles", roundTriangles}, {"locked", locked}, {"locked_before", before}});
    const auto triangles = static_cast<double>(report.summary.sourceTriangles);
    nlohmann::ordered_json json = {
        {"source_triangles", report.summary.sourceTriangles},
        {"source_vertices", report.summary.sourceVertices},
        {"dropped", report.summary.dropped},
        {"attributes_dropped", attributesDropped(report, source)},
        {"cameras", source.cameras.size()},
        {"texels_per_edge",
         source.texelsPerEdge ? nlohmann::ordered_json(*source.texelsPerEdge) : nlohmann::ordered_json()},
        {"fields", source.fields},
        {"clusters", clusters},
        {"groups", groups},
        {"level_count", report.summary.levels.size()},
        {"pages", report.pages},
        {"coarsest_triangles", report.summary.coarsestTriangles},
        {"stuck_triangles", report.irreducibleTriangles},
        {"file_bytes", report.fileBytes},
        {"bytes_per_source_triangle", static_cast<double>(report.fileBytes) / triangles},
        {"peak_rss_bytes", peakResidentBytes},
        {"temporary_bytes", report.temporaryBytes},
        {"seconds", report.seconds},
        {"phases", phasesJson(report)},
        {"rounds", rounds},
        {"triangles_per_second", report.seconds > 0 ? triangles / report.seconds : 0},
        {"content_hash", report.contentHash},
        {"up", hierarchy::upAxisText(report.summary.up)},
        {"up_because", report.summary.options.at("up")},
        {"up_confidence", report.summary.options.at("up_confidence")},
        {"unit", hierarchy::rowOf(report.summary.unit).name},
    };
    for (const ProcessReport& process : report.processes)
        json["ranks"].push_back(
            {{"rank", process.rank},
             {"host", process.host},
             {"threads", process.threads},
             {"tasks", process.tasks},
             {"busy_seconds", process.busySeconds},
             {"peak_rss_bytes", process.peakResidentBytes},
             {"table_bytes", process.tableBytes},
             {"bytes_sent", process.bytesSent},
             {"scratch_bytes_read", process.bytesRead},
             {"scratch_bytes_written", process.bytesWritten}});
    return json;
}

} // namespace gnomon::pipeline
