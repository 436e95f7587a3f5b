// Which nodes join in which round, what of a build is remembered, and by which words two builds are the same.
#include "core/random.h"
#include "hierarchy/bytes.h"
#include "preprocess/levels/page_layout.h"
#include "preprocess/pipeline/build_key.h"
#include "preprocess/pipeline/checkpoint_log.h"
#include "preprocess/pipeline/rounds.h"
#include "preprocess/scratch/parted_scratch.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

NodeRecord nodeOf(std::uint64_t triangles, std::size_t levels = 1) {
    NodeRecord node;
    node.pending = {triangles / 100, triangles, triangles / 2};
    node.levels.resize(levels);
    return node;
}

TEST(Rounds, TheFirstHasANodeAChunk) {
    const Round round = firstRound(3);
    EXPECT_EQ(round.number, 0U);
    EXPECT_EQ(round.firstLevel, 0U);
    EXPECT_EQ(round.nodeCount, 3U);
    EXPECT_FALSE(round.isLast);
    EXPECT_TRUE(firstRound(1).isLast) << "a single chunk is built up to its root";
}

TEST(Rounds, TheNextBeginsAboveTheHighestLevelOfAll) {
    const std::vector<NodeRecord> nodes{nodeOf(40000, 2), nodeOf(50000, 3), nodeOf(20000, 1)};
    RoundRecord record;
    record.nodes = {{7, 60000, 20000}, {8, 50000, 30000}};
    Round next = roundAfter(firstRound(3), nodes, record);
    EXPECT_EQ(next.number, 1U);
    EXPECT_EQ(next.firstLevel, 3U);
    EXPECT_EQ(next.nodeCount, 2U);
    EXPECT_EQ(next.largestNode.triangles, 60000U);
    EXPECT_EQ(next.largestNode.vertices, 30000U);
    EXPECT_FALSE(next.isLast);
    record.isLast = true;
    next = roundAfter(next, nodes, record);
    EXPECT_EQ(next.number, 2U);
    EXPECT_EQ(next.firstLevel, 6U);
    EXPECT_TRUE(next.isLast);
}

TEST(Rounds, ARoundOfOneNodeOrAfterLittleProgressIsTheLast) {
    EXPECT_TRUE(isLastRound(1, 100, 1000));
    EXPECT_FALSE(isLastRound(2, 100, 1000));
    EXPECT_FALSE(isLastRound(2, 800, 1000));
    EXPECT_TRUE(isLastRound(2, 801, 1000)) << "it is not borders that keep the triangles";
    EXPECT_EQ(nodeTriangles(100), 8192U) << "so few are always affordable";
    EXPECT_EQ(nodeTriangles(100'000), 100'000U);
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
    record.dropped = {17, 18, 19, 20};
    record.directory = {std::byte{1}, std::byte{2}};
    record.furthest = {1, 0x7FFFFFFF, 3};
    record.mainPart = {{-1, -2, -3}, {4, 5, 6}};
    record.medianEdge = 0.3;
    record.badNormals = 21;
    record.strayed = {8, {{1, 2, 3}, {7, 8, 9}}};
    return record;
}

RoundRecord someRound(std::uint32_t round) {
    RoundRecord record;
    record.round = round;
    record.isLast = true;
    record.nodes = {{1, 2, 3}, {4, 5, 6}};
    record.locks = {7, 8};
    record.directory = {std::byte{10}};
    return record;
}

NodeRecord someNode(std::uint32_t round, std::uint32_t firstLevel, std::uint32_t number = 0) {
    NodeRecord node = nodeOf(321, 2);
    node.round = round;
    node.node = number;
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
    node.places = {11, 12, 18};
    node.clusters = {23, 24, std::uint64_t{25} << 56U};
    node.rootTriangles = 13;
    node.irreducibleTriangles = 14;
    node.dropped = {15, 16, 17, 18};
    node.bounds = {{-1, -2, -3}, {1, 2, 3}};
    node.hasNormals = true;
    return node;
}

TEST(CheckpointLog, EveryRecordComesBackFromItsBytes) {
    CheckpointLog log;
    log.addEncoded(encoded(someBinned()));
    log.addEncoded(encoded(BorderedRecord{{std::byte{9}}}));
    log.addEncoded(encoded(someNode(0, 0)));
    EXPECT_EQ(log.binnedRound(1), nullptr);
    log.addEncoded(encoded(someRound(1)));
    ASSERT_NE(log.binnedRound(1), nullptr);
    EXPECT_EQ(encoded(*log.binnedRound(1)), encoded(someRound(1)));
    EXPECT_TRUE(log.binnedRound(1)->isLast);
    EXPECT_EQ(log.binnedRound(1)->nodes[1].vertices, 6U);
    EXPECT_EQ(log.binnedRound(1)->locks.lockedBefore, 8U);
    EXPECT_EQ(log.binnedRound(0), nullptr) << "the chunks have their own";
    EXPECT_EQ(log.binnedRound(2), nullptr);
    ASSERT_TRUE(log.binned());
    EXPECT_EQ(log.binned()->furthest, (hierarchy::GridPoint{1, 0x7FFFFFFF, 3}));
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
    EXPECT_EQ(log.binned()->directory, someBinned().directory);
    EXPECT_EQ(log.binned()->mainPart.max, glm::dvec3(4, 5, 6));
    EXPECT_EQ(log.binned()->medianEdge, 0.3);
    EXPECT_EQ(log.binned()->badNormals, 21U);
    EXPECT_EQ(log.binned()->strayed.triangles, 8U);
    EXPECT_EQ(log.binned()->strayed.corners.min, glm::dvec3(1, 2, 3));
    ASSERT_TRUE(log.bordered());
    EXPECT_EQ(log.bordered()->directory, std::vector<std::byte>{std::byte{9}});
    ASSERT_EQ(log.nodes(0).size(), 1U);
    // A record of the same bytes has the same fields.
    EXPECT_EQ(encoded(log.nodes(0)[0]), encoded(someNode(0, 0)));
    const hierarchy::PageInfo& page = log.nodes(0)[0].levels[0].pages[1];
    EXPECT_EQ(page.offset, 77U);
    EXPECT_EQ(page.children, (std::vector<std::uint32_t>{3, 5}));
    EXPECT_EQ(page.bounds.radius, 4);
    EXPECT_EQ(log.nodes(0)[0].dropped, (DroppedCounts{15, 16, 17, 18}));
}

TEST(CheckpointLog, CountsThePagesBeforeEachNode) {
    CheckpointLog log;
    EXPECT_EQ(log.roundCount(), 0U);
    EXPECT_TRUE(log.nodes(7).empty());
    log.add(someNode(0, 0)); // three pages of level 0, one of level 1
    log.add(someNode(0, 0, 1));
    log.beginRound(1);
    EXPECT_EQ(log.roundCount(), 2U);
    log.add(someNode(1, 1)); // three of level 1, one of level 2
    EXPECT_EQ(log.pageCounts(), (std::vector<std::uint32_t>{6, 5, 1}));
    EXPECT_EQ(log.firstPages(0, 0), (std::vector<std::uint32_t>{0, 0}));
    EXPECT_EQ(log.firstPages(0, 1), (std::vector<std::uint32_t>{3, 1}));
    EXPECT_EQ(log.firstPages(1, 0), (std::vector<std::uint32_t>{2, 0}));
}

TEST(CheckpointLog, NodesInAnyOrderComeToTheSame) {
    const auto logOf = [](const std::vector<std::uint32_t>& order) {
        CheckpointLog log;
        for (const std::uint32_t number : order) {
            NodeRecord node = someNode(0, 0, number);
            node.places.offset = scratch::placeOf(number, 11);
            node.clusters.offset = scratch::placeOf(number, 23);
            node.levels[0].pages[1].offset = scratch::placeOf(number, 77);
            node.levels[0].pages[2].offset = scratch::placeOf(number, 200);
            node.levels[0].pages[2].storedBytes = 10;
            node.levels[1].pages[0].children = {levels::provisionalId(0, 2), levels::provisionalId(0, 0)};
            log.addEncoded(encoded(node));
        }
        return log;
    };
    const CheckpointLog plain = logOf({0, 1, 2, 3});
    EXPECT_EQ(
        plain.nodes(0)[2].levels[1].pages[0].children,
        (std::vector<std::uint32_t>{levels::provisionalId(0, 8), levels::provisionalId(0, 6)}))
        << "behind the three pages of each node before it";
    const CheckpointLog other = logOf({2, 0, 3, 1});
    EXPECT_EQ(other.pageCounts(), plain.pageCounts());
    EXPECT_EQ(other.scratchBytes(), plain.scratchBytes());
    EXPECT_EQ(plain.scratchBytes().at(3), 210U);
    ASSERT_EQ(other.nodes(0).size(), 4U);
    for (std::uint32_t node = 0; node < 4; ++node) {
        EXPECT_EQ(encoded(other.nodes(0)[node]), encoded(plain.nodes(0)[node]));
        EXPECT_EQ(other.firstPages(0, node), plain.firstPages(0, node));
    }
    const CheckpointLog holed = logOf({2, 0});
    EXPECT_EQ(holed.nodes(0).size(), 1U) << "up to the first that is not built";
    EXPECT_TRUE(holed.isBuilt(0, 2) && holed.isBuilt(0, 0));
    EXPECT_FALSE(holed.isBuilt(0, 1) || holed.isBuilt(0, 3) || holed.isBuilt(1, 0));
    EXPECT_EQ(holed.builtTriangles(0), plain.builtTriangles(0) / 2);
    EXPECT_EQ(holed.scratchBytes().at(2), 210U);
    CheckpointLog shared;
    shared.add(someNode(0, 0));
    shared.add(someNode(0, 0, 1));
    EXPECT_THROW(shared.scratchBytes(), hierarchy::Damage) << "blocks of two nodes at one place";
    EXPECT_THROW(logOf({2, 0, 2}), hierarchy::Damage) << "built twice";
    EXPECT_THROW(logOf({0, 0}), hierarchy::Damage);
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
    EXPECT_THROW(CheckpointLog().addEncoded(encoded(someRound(2))), hierarchy::Damage) << "round 1 is missing";
}

TEST(CheckpointLog, RecordsThatDoNotBelongTogetherAreRefused) {
    NoProgress progress;
    scratch::TemporarySpace space(progress);
    const auto file = scratch::scratchInMemory(space);
    const auto directoryOf = [&](std::uint32_t streams) { return scratch::StreamStore(*file, streams, 1).directory(); };
    BinnedRecord binned = someBinned();
    binned.chunkCount = 2;
    binned.directory = directoryOf(chunk::binStreams(2));
    NodeRecord node = someNode(0, 0);
    node.pending.clusters = 3;
    node.places.bytes = levels::placeBytes(3);
    node.levels[0].pages[1].children.clear();
    node.levels[1].pages[0].children = {levels::provisionalId(0, 2)};
    const auto check = [](const BinnedRecord& record, const NodeRecord& built, std::optional<BorderedRecord> bordered) {
        CheckpointLog log;
        log.add(record);
        if (bordered) log.add(*bordered);
        log.add(built);
        log.requireConsistent();
    };
    EXPECT_NO_THROW(check(binned, node, BorderedRecord{directoryOf(chunk::borderStreams(2))}));
    EXPECT_THROW(check(binned, node, BorderedRecord{directoryOf(chunk::borderStreams(3))}), hierarchy::Damage);
    BinnedRecord others = binned;
    for (const std::uint32_t count : {0U, 1U, 3U, ~0U}) {
        others.chunkCount = count;
        EXPECT_THROW(check(others, node, {}), hierarchy::Damage) << count;
    }
    NodeRecord bad = node;
    bad.node = 2;
    EXPECT_THROW(check(binned, bad, {}), hierarchy::Damage);
    bad = node;
    bad.pending.clusters = std::uint64_t{1} << 62U;
    EXPECT_THROW(check(binned, bad, {}), hierarchy::Damage);
    bad = node;
    bad.firstLevel = ~0U - 1;
    CheckpointLog log;
    EXPECT_THROW(log.addEncoded(encoded(bad)), hierarchy::Damage);
    for (const std::uint32_t child : {levels::provisionalId(0, 3), levels::provisionalId(7, 0)}) {
        bad = node;
        bad.levels[1].pages[0].children = {child};
        EXPECT_THROW(check(binned, bad, {}), hierarchy::Damage);
    }
    log.add(someRound(1));
    EXPECT_THROW(log.requireConsistent(), hierarchy::Damage) << "no chunks";
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
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.error = levels::ErrorKind::Estimated; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.error = levels::ErrorKind::Tight; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.simplifier = simplify::Simplifier::Meshopt; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.level.simplifier = simplify::Simplifier::OpenMesh; }));
    EXPECT_TRUE(differs([](BuildOptions& o) { o.inputKey = "input 1 bytes 5"; }));
}

} // namespace
} // namespace gnomon::pipeline
