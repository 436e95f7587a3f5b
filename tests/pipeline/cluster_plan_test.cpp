// Where clusters go between two rounds: within bounds, along the curve, and never with a border where the last one was.
#include "core/random.h"
#include "preprocess/pipeline/cluster_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace gnomon::pipeline {
namespace {

using hierarchy::GridPoint;

std::vector<levels::ClusterPlace> randomPlaces(Random& random, std::size_t count, std::uint32_t furthest) {
    std::vector<levels::ClusterPlace> places;
    const auto coordinate = [&] { return static_cast<std::uint32_t>(random.below(std::uint64_t{furthest} + 1)); };
    for (std::size_t i = 0; i < count; ++i)
        places.push_back(
            {{coordinate(), coordinate(), coordinate()},
             static_cast<std::uint32_t>(1 + random.below(128)),
             static_cast<std::uint32_t>(3 + random.below(250)),
             0});
    return places;
}

TEST(ClusterPlan, EachNodeKeepsTheLimitAndItsSumsAreThoseOfItsClusters) {
    Random random(1);
    for (const std::uint32_t furthest : {1U, 1000U, 0x7FFFFFFFU})
        for (const std::uint32_t round : {1U, 2U, 3U, 4U}) {
            const auto places = randomPlaces(random, 3000, furthest);
            const ClusterPlan plan = planClusters(places, {furthest, furthest, furthest}, round, 8192);
            ASSERT_EQ(plan.nodeOf.size(), places.size());
            std::vector<ClusterSums> sums(plan.nodes.size());
            for (std::size_t c = 0; c < places.size(); ++c) {
                ASSERT_LT(plan.nodeOf[c], sums.size());
                ClusterSums& sum = sums[plan.nodeOf[c]];
                ++sum.clusters;
                sum.triangles += places[c].triangles;
                sum.vertices += places[c].vertices;
            }
            for (std::size_t node = 0; node < sums.size(); ++node) {
                EXPECT_LE(sums[node].triangles, 8192U);
                EXPECT_GT(sums[node].clusters, 0U);
                EXPECT_EQ(sums[node].clusters, plan.nodes[node].clusters);
                EXPECT_EQ(sums[node].triangles, plan.nodes[node].triangles);
                EXPECT_EQ(sums[node].vertices, plan.nodes[node].vertices);
            }
            EXPECT_LT(plan.nodes.size(), 3 * (3000U * 65 / 8192 + 1)) << "few are needlessly small";
        }
}

TEST(ClusterPlan, MoreAtOnePointThanANodeMayHaveFillOneAfterTheOther) {
    std::vector<levels::ClusterPlace> places(500, {{7, 7, 7}, 100, 60, 0});
    const ClusterPlan plan = planClusters(places, {7, 7, 7}, 1, 8192);
    EXPECT_EQ(plan.nodes.size(), 7U); // of 81 clusters each
    EXPECT_TRUE(std::is_sorted(plan.nodeOf.begin(), plan.nodeOf.end()));
    for (const ClusterSums& node : plan.nodes)
        EXPECT_LE(node.triangles, 8192U);
    EXPECT_TRUE(planClusters({}, {7, 7, 7}, 1, 8192).nodes.empty());
}

TEST(ClusterPlan, FewAreOneNode) {
    Random random(2);
    const auto places = randomPlaces(random, 60, 1000);
    EXPECT_EQ(planClusters(places, {1000, 1000, 1000}, 2, 8192).nodes.size(), 1U);
}

/// How far `face` is from the nearest face of cells of the size `cell` that are shifted by `shift`.
std::uint64_t distanceToFaces(std::uint64_t face, std::uint64_t cell, std::uint64_t shift) {
    const std::uint64_t remainder = (face + shift) % cell;
    return std::min(remainder, cell - remainder);
}

TEST(ClusterPlan, FacesOfCellsLieAThirdOfACellFromThoseOfTheRoundsBesides) {
    for (const std::uint32_t furthest : {1000U, 0xFFFFFU, 0x7FFFFFFFU})
        for (std::uint32_t round = 0; round < 6; ++round) {
            const std::uint64_t root = std::uint64_t{1} << static_cast<unsigned>(std::bit_width(furthest));
            const std::uint64_t shift = cellShift({furthest, 3, 5}, round);
            const std::uint64_t next = cellShift({furthest, 3, 5}, round + 1);
            EXPECT_LT(shift + furthest, std::uint64_t{1} << 32U);
            for (std::uint64_t cell = root; cell >= 8; cell /= 2)
                for (std::uint64_t other = cell; other >= 8; other /= 2) // where one round's cells are finer
                    for (std::uint64_t i = 0; i < std::min<std::uint64_t>(root / cell, 50); ++i) {
                        const std::uint64_t face = cell * (i + 2) - shift;
                        EXPECT_GE(distanceToFaces(face, other, next) + 1, other / 3) << round << " " << cell;
                    }
        }
}

TEST(ClusterPlan, NeighboursInOneNodeAreParted) {
    // A line of clusters: the borders of one round are inside nodes of the next.
    std::vector<levels::ClusterPlace> places;
    for (std::uint32_t i = 0; i < 4096; ++i)
        places.push_back({{i * 16, 30000, 30000}, 100, 60, 0});
    const GridPoint furthest{65535, 65535, 65535};
    std::map<std::uint32_t, std::uint32_t> roundsWithBorder;
    for (std::uint32_t round = 0; round < 3; ++round) {
        const ClusterPlan plan = planClusters(places, furthest, round, 8192);
        for (std::uint32_t i = 1; i < 4096; ++i)
            if (plan.nodeOf[i] != plan.nodeOf[i - 1]) ++roundsWithBorder[i];
    }
    EXPECT_GT(roundsWithBorder.size(), 100U);
    for (const auto& [place, rounds] : roundsWithBorder)
        EXPECT_EQ(rounds, 1U) << place;
}

} // namespace
} // namespace gnomon::pipeline
