#include "core/random.h"
#include "preprocess/pipeline/memory_plan.h"

#include <gtest/gtest.h>

namespace gnomon::pipeline {
namespace {

read::MeshSummary sourceOf(std::uint64_t triangles, std::uint64_t vertices) {
    read::MeshSummary source;
    source.faceCount = triangles;
    source.vertexCount = vertices;
    return source;
}

TEST(MemoryPlan, TheMostHoldsEveryPhaseAndGrowsWithTheSource) {
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        const read::MeshSummary source = sourceOf(1 + random.below(400'000'000), 3 + random.below(200'000'000));
        const MemoryNeeds needs{source, static_cast<std::uint32_t>(1000 + random.below(2'000'000)), i % 2 == 0};
        EXPECT_GE(needs.peak(), needs.survey());
        EXPECT_GE(needs.peak(), needs.binning());
        EXPECT_GT(needs.peak(), needs.base());
        EXPECT_GE(needs.peak(), needs.sorting());
        EXPECT_GE(needs.sorting(), needs.binning());
        MemoryNeeds ofMany = needs;
        ofMany.threads = 64;
        EXPECT_GE(ofMany.peak(), needs.peak());
        read::MeshSummary larger = source;
        larger.faceCount *= 2;
        larger.vertexCount *= 2;
        EXPECT_GE((MemoryNeeds{larger, needs.chunkTriangles, needs.isInMemory}.peak()), needs.peak());
        EXPECT_GE(
            (MemoryNeeds{source, needs.chunkTriangles, true}.base()),
            (MemoryNeeds{source, needs.chunkTriangles, false}.base()));
        read::MeshSummary held = source;
        held.heldBytes = 12345;
        EXPECT_EQ((MemoryNeeds{held, needs.chunkTriangles, needs.isInMemory}.base().count), needs.base().count + 12345);
    }
}

TEST(MemoryPlan, PolygonsCountAsTheTrianglesThatTheyBecome) {
    read::MeshSummary quads = sourceOf(1000, 1000);
    quads.likelyTriangles = 2000;
    EXPECT_EQ((MemoryNeeds{quads, 100, true}.base()), (MemoryNeeds{sourceOf(2000, 1000), 100, true}.base()));
}

TEST(MemoryPlan, RowsOfPagesTakeLittleUnlessChunksAreSmall) {
    const read::MeshSummary statue = sourceOf(1'000'000'000, 500'000'000);
    const auto base = [](const read::MeshSummary& source, std::uint32_t chunkTriangles) {
        return MemoryNeeds{source, chunkTriangles, false}.base().count;
    };
    EXPECT_LT((MemoryNeeds{statue, 1U << 20U, false}.peak()), gibibytes(2));
    const std::uint64_t process = base(sourceOf(1, 3), 1U << 20U);
    EXPECT_GT(base(statue, 1U << 20U), process + 48'000'000) << "measured: 0.048 bytes a triangle";
    EXPECT_LT(base(statue, 1U << 20U), process + 70'000'000);
    EXPECT_GE(base(statue, 64), process + 1'000'000'000 - 1) << "as much as a byte a triangle";
}

TEST(MemoryPlan, ASmallSourceNeedsLittleMoreThanTheProcess) {
    read::MeshSummary source = sourceOf(1000, 500);
    source.fileBytes = 19'000;
    for (const bool hasRanges : {false, true}) {
        source.hasRanges = hasRanges;
        EXPECT_LT((MemoryNeeds{source, 1U << 20U}.peak()), mebibytes(24));
    }
}

TEST(MemoryPlan, BlocksShareTheirRoomWithinBounds) {
    EXPECT_EQ(blockBytes({100000}, 10), 10000U);
    EXPECT_EQ(blockBytes({100}, 10), 512U) << "no smaller";
    EXPECT_EQ(blockBytes(gibibytes(1), 10), 65536U) << "and no larger";
    EXPECT_EQ(countAtOnce({1000}, {100}, 64), 10U);
    EXPECT_EQ(countAtOnce({1000}, {1001}, 64), 0U);
    EXPECT_EQ(countAtOnce({1000}, {100}, 2), 3U) << "one more than threads";
    EXPECT_EQ(countAtOnce({1000}, {0}, 2), 3U);
}

} // namespace
} // namespace gnomon::pipeline
