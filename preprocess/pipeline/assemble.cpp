#include "preprocess/pipeline/assemble.h"

#include "hierarchy/main_part.h"
#include "preprocess/levels/page_layout.h"

namespace gnomon::pipeline {

namespace {

using hierarchy::PageInfo;

/// Calls `take(level of the node, level number)` for each level of detail in each node record.
template <class Take>
void forEachLevel(const CheckpointLog& log, const Take& take) {
    for (std::uint32_t round = 0; round < log.roundCount(); ++round)
        for (const NodeRecord& node : log.nodes(round))
            for (std::size_t i = 0; i < node.levels.size(); ++i)
                take(node.levels[i], node.firstLevel + i);
}

/// Returns the page id of the first page of each level in the file.
std::vector<std::uint32_t> firstPageIds(const CheckpointLog& log) {
    const std::vector<std::uint32_t>& counts = log.pageCounts();
    std::vector<std::uint32_t> first(counts.size(), 0);
    for (std::size_t level = counts.size(); level-- > 1;)
        first[level - 1] = first[level] + counts[level];
    return first;
}

} // namespace

DroppedCounts droppedTriangles(const CheckpointLog& log) {
    DroppedCounts dropped = log.binned()->dropped;
    for (const NodeRecord& node : log.nodes(0))
        for (std::size_t i = 0; i < dropped.size(); ++i)
            dropped[i] += node.dropped[i];
    return dropped;
}

Totals totalsOf(const CheckpointLog& log, std::map<std::string, std::string> options) {
    Totals totals;
    hierarchy::ModelSummary& summary = totals.summary;
    summary.grid = log.binned()->grid;
    summary.sourceTriangles = log.binned()->triangles;
    summary.sourceVertices = log.binned()->vertices;
    summary.hasColors = log.binned()->format.hasColors;
    summary.fields = log.binned()->fields;
    summary.options = std::move(options);
    const DroppedCounts dropped = droppedTriangles(log);
    summary.dropped = {
        {"degenerate", dropped[0]},
        {"doubled", dropped[1]},
        {"collapsed_by_grid", dropped[2]},
        {"beyond_grid", log.binned()->strayed.triangles},
        {"not_a_polygon", log.binned()->notAPolygon}};
    if (dropped[3] > 0) summary.dropped["covered"] = dropped[3];
    for (std::uint32_t round = 0; round < log.roundCount(); ++round)
        for (const NodeRecord& node : log.nodes(round)) {
            summary.bounds.add(node.bounds);
            summary.hasNormals = summary.hasNormals || node.hasNormals;
            summary.coarsestTriangles += node.rootTriangles;
            totals.irreducibleTriangles += node.irreducibleTriangles;
        }
    hierarchy::setMainPart(summary, log.binned()->mainPart);
    summary.levels.resize(log.pageCounts().size());
    forEachLevel(log, [&](const NodeRecord::LevelOfNode& level, std::size_t number) {
        hierarchy::LevelInfo& sum = summary.levels[number];
        sum.triangles += level.info.triangles;
        sum.clusters += level.info.clusters;
        sum.groups += level.info.groups;
        sum.maxError = std::max(sum.maxError, level.info.maxError);
        sum.maxAttributeError = std::max(sum.maxAttributeError, level.info.maxAttributeError);
        totals.pages += level.pages.size();
    });
    return totals;
}

std::vector<std::span<const PageInfo>> pagesOf(const CheckpointLog& log) {
    std::vector<std::span<const PageInfo>> pages;
    forEachLevel(log, [&](const NodeRecord::LevelOfNode& level, std::size_t) { pages.emplace_back(level.pages); });
    return pages;
}

void forEachPage(const CheckpointLog& log, const std::function<void(const PageInfo&, std::uint64_t)>& take) {
    std::vector<std::vector<const NodeRecord::LevelOfNode*>> levels(log.pageCounts().size());
    forEachLevel(
        log, [&](const NodeRecord::LevelOfNode& level, std::size_t number) { levels[number].push_back(&level); });
    const std::vector<std::uint32_t> first = firstPageIds(log);
    PageInfo page;
    for (std::size_t number = levels.size(); number-- > 0;)
        for (const NodeRecord::LevelOfNode* level : levels[number])
            for (const PageInfo& info : level->pages) {
                page = info;
                for (std::uint32_t& child : page.children) {
                    const levels::PageOfLevel place = levels::placeOfProvisional(child);
                    child = first[place.level] + place.page;
                }
                take(page, info.offset);
            }
}

} // namespace gnomon::pipeline
