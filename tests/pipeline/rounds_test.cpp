// Which nodes join in which round, what of a build is remembered, and by which words two builds are the same.
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/rounds.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

NodeRecord nodeOf(std::uint64_t triangles, std::size_t levels = 1) {
    NodeRecord node;
    node.pending.triangles = triangles;
    node.pending.vertices = triangles / 2;
    node.levels.resize(levels);
    return node;
}

TEST(Rounds, TheFirstHasANodeAChunk) {
    const Round round = firstRound(3);
    EXPECT_EQ(round.number, 0U);
    EXPECT_EQ(round.firstLevel, 0U);
    EXPECT_EQ(round.ends, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(round.nodeCount(), 3U);
    EXPECT_EQ(round.firstChild(0), 0U);
    EXPECT_EQ(round.firstChild(2), 2U);
    EXPECT_FALSE(round.isLast);
    EXPECT_TRUE(firstRound(1).isLast) << "a single chunk is built up to its root";
}

TEST(Rounds, NeighboursJoinAsLongAsTheyFit) {
    const Round first = firstRound(5);
    const std::vector<NodeRecord> nodes{
        nodeOf(40000, 3), nodeOf(50000, 2), nodeOf(20000, 1), nodeOf(90000, 3), nodeOf(9000, 3)};
    const Round next = nextRound(first, nodes, 100000);
    EXPECT_EQ(next.number, 1U);
    EXPECT_EQ(next.firstLevel, 3U) << "above the highest of all";
    EXPECT_EQ(next.ends, (std::vector<std::uint32_t>{2, 3, 5}));
    EXPECT_EQ(next.firstChild(2), 3U);
    EXPECT_EQ(next.largestNode.triangles, 99000U);
    EXPECT_EQ(next.largestNode.vertices, 49500U);
    EXPECT_FALSE(next.isLast);
    EXPECT_EQ(nextRound(first, nodes, 90000).ends, (std::vector<std::uint32_t>{2, 3, 4, 5})) << "just as many as fit";
    EXPECT_EQ(nextRound(first, nodes, 89999).ends, (std::vector<std::uint32_t>{1, 3, 4, 5}));
}

TEST(Rounds, ARoundInWhichNothingJoinsOrAllDoesIsTheLast) {
    const Round first = firstRound(2);
    EXPECT_TRUE(nextRound(first, {nodeOf(20000), nodeOf(20000)}, 30000).isLast) << "none could join another";
    EXPECT_TRUE(nextRound(first, {nodeOf(20000), nodeOf(20000)}, 40000).isLast) << "one is left";
    EXPECT_EQ(nextRound(first, {nodeOf(4096), nodeOf(4096)}, 0).nodeCount(), 1U) << "so few are always affordable";
    EXPECT_EQ(nextRound(first, {nodeOf(4096), nodeOf(4097)}, 0).nodeCount(), 2U);
}

TEST(Rounds, AnyNumberOfNodesEndsInOne) {
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        Round round = firstRound(static_cast<std::uint32_t>(1 + random.below(200)));
        int rounds = 0;
        while (!round.isLast) {
            ASSERT_LT(++rounds, 50);
            std::vector<NodeRecord> nodes;
            for (std::size_t i = 0; i < round.nodeCount(); ++i)
                nodes.push_back(nodeOf(random.below(60000), 1 + random.below(3)));
            const Round next = nextRound(round, nodes, 100000);
            ASSERT_EQ(next.ends.back(), nodes.size()) << "every node has a parent";
            for (std::size_t i = 0; i < next.nodeCount(); ++i)
                ASSERT_LT(next.firstChild(i), next.ends[i]);
            round = next;
        }
    }
}

BinnedRecord someBinned() {
    BinnedRecord record;
    record.grid = {{1, 2.5, -3}, -12};
    record.format = {true, false, true};
    record.triangles = 1234567890123;
    record.vertices = 42;
    record.notAPolygon = 7;
    record.chunkCount = 99;
    record.largestChunk = {5, 6};
    record.dropped = {17, 18, 19};
    record.scratchEnd = 8;
    record.directory = {std::byte{1}, std::byte{2}};
    return record;
}

NodeRecord someNode(std::uint32_t round, std::uint32_t firstLevel) {
    NodeRecord node = nodeOf(321, 2);
    node.round = round;
    node.firstLevel = firstLevel;
    node.levels[0].info = {10, 20, 30, 0.5};
    node.levels[0].pages.resize(3);
    node.levels[0].pages[1].offset = 77;
    node.levels[0].pages[1].storedBytes = 78;
    node.levels[0].pages[1].checksum = 79;
    node.levels[0].pages[1].box = {{1, 2, 3}, {4, 5, 6}};
    node.levels[0].pages[1].bounds = {{1, 2, 3}, 4};
    node.levels[0].pages[1].minError = 0.25;
    node.levels[0].pages[1].maxError = 0.75;
    node.levels[0].pages[1].children = {3, 5};
    node.levels[1].pages.resize(1);
    node.pendingOffset = 11;
    node.pendingBytes = 12;
    node.rootTriangles = 13;
    node.stuckTriangles = 14;
    node.dropped = {15, 16, 17};
    node.bounds = {{-1, -2, -3}, {1, 2, 3}};
    node.hasNormals = true;
    return node;
}

TEST(CheckpointLog, EveryRecordComesBackFromItsBytes) {
    CheckpointLog log;
    log.addEncoded(encoded(someBinned()));
    log.addEncoded(encoded(BorderedRecord{55, {std::byte{9}}}));
    log.addEncoded(encoded(someNode(0, 0)));
    ASSERT_TRUE(log.binned());
    EXPECT_EQ(log.binned()->grid.origin, glm::dvec3(1, 2.5, -3));
    EXPECT_EQ(log.binned()->grid.stepExponent, -12);
    EXPECT_TRUE(log.binned()->format.isDouble && log.binned()->format.hasColors);
    EXPECT_FALSE(log.binned()->format.hasNormals);
    EXPECT_EQ(log.binned()->triangles, 1234567890123U);
    EXPECT_EQ(log.binned()->vertices, 42U);
    EXPECT_EQ(log.binned()->notAPolygon, 7U);
    EXPECT_EQ(log.binned()->chunkCount, 99U);
    EXPECT_EQ(log.binned()->largestChunk.triangles, 5U);
    EXPECT_EQ(log.binned()->largestChunk.vertices, 6U);
    EXPECT_EQ(log.binned()->scratchEnd, 8U);
    EXPECT_EQ(log.binned()->directory, someBinned().directory);
    ASSERT_TRUE(log.bordered());
    EXPECT_EQ(log.bordered()->scratchEnd, 55U);
    EXPECT_EQ(log.bordered()->directory, std::vector<std::byte>{std::byte{9}});
    ASSERT_EQ(log.nodes(0).size(), 1U);
    // A record of the same bytes has the same fields.
    EXPECT_EQ(encoded(log.nodes(0)[0]), encoded(someNode(0, 0)));
    const hierarchy::PageInfo& page = log.nodes(0)[0].levels[0].pages[1];
    EXPECT_EQ(page.offset, 77U);
    EXPECT_EQ(page.children, (std::vector<std::uint32_t>{3, 5}));
    EXPECT_EQ(page.bounds.radius, 4);
    EXPECT_EQ(log.nodes(0)[0].dropped, (std::array<std::uint64_t, 3>{15, 16, 17}));
}

TEST(CheckpointLog, CountsThePagesBeforeEachNode) {
    CheckpointLog log;
    EXPECT_EQ(log.roundCount(), 0U);
    EXPECT_TRUE(log.nodes(7).empty());
    log.add(someNode(0, 0)); // three pages of level 0, one of level 1
    log.add(someNode(0, 0));
    log.beginRound(1);
    EXPECT_EQ(log.roundCount(), 2U);
    log.add(someNode(1, 1)); // three of level 1, one of level 2
    EXPECT_EQ(log.pageCounts(), (std::vector<std::uint32_t>{6, 5, 1}));
    EXPECT_EQ(log.firstPages(0, 0), (std::vector<std::uint32_t>{0, 0}));
    EXPECT_EQ(log.firstPages(0, 1), (std::vector<std::uint32_t>{3, 1}));
    EXPECT_EQ(log.firstPages(1, 0), (std::vector<std::uint32_t>{2, 0}));
}

TEST(CheckpointLog, DamagedRecordsAreRefused) {
    const std::vector<std::byte> good = encoded(someNode(0, 0));
    for (std::size_t size = 0; size + 1 < good.size(); size += 3) {
        CheckpointLog log;
        std::vector<std::byte> cut(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size));
        if (!cut.empty()) cut.back() = good.back(); // its kind
        EXPECT_THROW(log.addEncoded(cut), hierarchy::Damage) << size;
    }
    std::vector<std::byte> other = good;
    other.back() = std::byte{77};
    EXPECT_THROW(CheckpointLog().addEncoded(other), hierarchy::Damage);
    std::vector<std::byte> longer = good;
    longer.insert(longer.end() - 1, std::byte{0});
    EXPECT_THROW(CheckpointLog().addEncoded(longer), hierarchy::Damage);
    EXPECT_THROW(CheckpointLog().addEncoded({}), hierarchy::Damage);
}

TEST(BuildKey, HasWhatChangesBytesAndNothingElse) {
    BuildOptions options;
    const std::string key = keyOf(options);
    for (const char* part : {"format ", "checkpoints ", "chunk_triangles 1048576", "error measured", "simplifier own"})
        EXPECT_NE(key.find(part), std::string::npos) << part << " in " << key;
    BuildOptions same = options;
    same.memory = mebibytes(77);
    same.threads = 5;
    same.isInMemory = true;
    same.output = "elsewhere.gnm";
    same.temporaryFolder = "/tmp";
    EXPECT_EQ(keyOf(same), key);
    EXPECT_EQ(optionsOf(same), optionsOf(options));
    const auto differs = [&](auto&& change) {
        BuildOptions other = options;
        change(other);
        return keyOf(other) != key;
    };
    EXPECT_TRUE(differs([](BuildOptions& o) { o.chunkTriangles = 5; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.clusterTriangles = 64; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.isErrorMeasured = false; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.simplifier = simplify::Simplifier::Meshopt; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.simplifier = simplify::Simplifier::OpenMesh; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.inputKey = "input 1 bytes 5"; }));
}

} // namespace
} // namespace gnomon::pipeline
