// What a build's records add up to, where its pages go, and the memory that its chunks call for.
#include "core/random.h"
#include "hierarchy/main_part.h"
#include "preprocess/levels/page_layout.h"
#include "preprocess/pipeline/assemble.h"
#include "preprocess/pipeline/counted_memory.h"
#include "tests/support/code_mesh.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

/// A node of `levels` levels from `firstLevel` on, whose figures are those of `seed`.
NodeRecord nodeWith(std::uint64_t seed, std::uint32_t round, std::uint32_t firstLevel, std::size_t levels) {
    NodeRecord node;
    node.round = round;
    node.firstLevel = firstLevel;
    node.levels.resize(levels);
    for (NodeRecord::LevelOfNode& level : node.levels) {
        level.info = {10 * seed, 2 * seed, seed, 0.5 * static_cast<double>(seed)};
        level.pages.resize(seed);
    }
    node.rootTriangles = 100 * seed;
    node.irreducibleTriangles = 1000 * seed;
    node.dropped = {seed, 2 * seed, 3 * seed, 4 * seed};
    node.bounds = {glm::dvec3(-static_cast<double>(seed)), glm::dvec3(1)};
    node.hasNormals = seed == 2;
    return node;
}

TEST(Assemble, AddsUpWhatTheNodesHave) {
    CheckpointLog log;
    BinnedRecord binned;
    binned.grid = {{-4, -4, -4}, -5};
    binned.format.hasColors = true;
    binned.triangles = 777;
    binned.vertices = 555;
    binned.notAPolygon = 4;
    binned.dropped = {10, 20, 30, 40};
    binned.strayed.triangles = 5;
    binned.mainPart = {{-0.5, -3, -3}, {2, 2, 2}};
    log.add(binned);
    log.add(nodeWith(1, 0, 0, 2));
    NodeRecord second = nodeWith(2, 0, 0, 2);
    second.node = 1;
    log.add(second);
    log.add(nodeWith(3, 1, 2, 1));
    EXPECT_EQ(droppedTriangles(log), (DroppedCounts{13, 26, 39, 52})) << "of the first round";
    const Totals totals = totalsOf(log, {{"simplifier", "own"}});
    const hierarchy::ModelSummary& summary = totals.summary;
    EXPECT_EQ(totals.pages, 2 * 1 + 2 * 2 + 3U);
    EXPECT_EQ(totals.irreducibleTriangles, 6000U);
    EXPECT_EQ(summary.coarsestTriangles, 600U);
    EXPECT_EQ(summary.grid.stepExponent, -5);
    EXPECT_EQ(summary.sourceTriangles, 777U);
    EXPECT_EQ(summary.sourceVertices, 555U);
    EXPECT_TRUE(summary.hasColors);
    EXPECT_TRUE(summary.hasNormals) << "one node has some";
    EXPECT_EQ(summary.bounds.min, glm::dvec3(-3));
    EXPECT_EQ(summary.bounds.max, glm::dvec3(1));
    const std::map<std::string, std::uint64_t> dropped{
        {"degenerate", 13},
        {"doubled", 26},
        {"collapsed_by_grid", 39},
        {"covered", 52},
        {"beyond_grid", 5},
        {"not_a_polygon", 4}};
    EXPECT_EQ(summary.dropped, dropped);
    EXPECT_EQ(summary.options.at("simplifier"), "own");
    EXPECT_EQ(mainPartOf(summary).min, glm::dvec3(-0.5, -3, -3));
    EXPECT_EQ(mainPartOf(summary).max, glm::dvec3(1));
    ASSERT_EQ(summary.levels.size(), 3U);
    EXPECT_EQ(summary.levels[0].triangles, 30U);
    EXPECT_EQ(summary.levels[1].clusters, 6U);
    EXPECT_EQ(summary.levels[1].groups, 3U);
    EXPECT_EQ(summary.levels[1].maxError, 1) << "the larger one";
    EXPECT_EQ(summary.levels[2].triangles, 30U);
}

TEST(CountedMemory, IsBetweenWhatSortingAndAnyChunksNeedAndGrowsWithTheChunks) {
    read::CodeMesh sheet = read::bumpySheet(120);
    NoProgress progress;
    Bytes last{0};
    for (const std::uint32_t chunkTriangles : {500U, 5000U, 1'000'000U}) {
        const MemoryNeeds needs{sheet.summary(), chunkTriangles, false};
        const Bytes counted = countedNeed(sheet, needs, gibibytes(1), progress);
        EXPECT_GE(counted.count, needs.sorting().count);
        EXPECT_GE(counted.count, last.count);
        last = counted;
        const MemoryNeeds whole{sheet.summary(), chunkTriangles, false};
        const chunk::PartSize all{sheet.summary().likelyTriangles, sheet.summary().vertexCount};
        EXPECT_LE(
            counted.count, std::max(needs.sorting().count, whole.building(all).count + MemoryNeeds::node(all).count))
            << "no chunk is larger than the source";
    }
}

} // namespace
} // namespace gnomon::pipeline
