// Pages: ids that sort as they will in the file, groups in order up to the target size, geometry as it was.
#include "core/random.h"
#include "hierarchy/page_codec.h"
#include "preprocess/levels/grouping.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/levels/page_layout.h"
#include "tests/levels/meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gnomon::levels {
namespace {

TEST(ProvisionalIds, TellTheirPlaceAndSortCoarsestFirst) {
    const std::array<std::uint32_t, 5> levels{0, 1, 7, kMaxLevels - 2, kMaxLevels - 1};
    const std::array<std::uint32_t, 4> pages{0, 1, 12345, kMaxLevelPages - 1};
    std::vector<std::uint32_t> inFileOrder;
    for (std::size_t level = levels.size(); level-- > 0;)
        for (const std::uint32_t page : pages) {
            const std::uint32_t id = provisionalId(levels.at(level), page);
            inFileOrder.push_back(id);
            const PageOfLevel place = placeOfProvisional(id);
            EXPECT_EQ(place.level, levels.at(level));
            EXPECT_EQ(place.page, page);
        }
    EXPECT_TRUE(std::is_sorted(inFileOrder.begin(), inFileOrder.end()));
    EXPECT_EQ(std::adjacent_find(inFileOrder.begin(), inFileOrder.end()), inFileOrder.end());
}

TEST(ProvisionalIdsDeathTest, OfMoreLevelsOrPagesThanThereAreFail) {
    EXPECT_DEATH(provisionalId(kMaxLevels, 0), "internal check failed");
    EXPECT_DEATH(provisionalId(0, kMaxLevelPages), "internal check failed");
}

struct Placed {
    /// Errors of groups that come after each other are `step` powers of two apart, up and down.
    explicit Placed(int step = 0) : mesh(meshOf(read::bumpySheet(200))), level(firstLevel(mesh, {})) {
        for (std::uint32_t c = 0; c < level.clusters.size(); ++c) {
            level.refinements.push_back({{2, c / 20, c % 20}, {glm::dvec3(c), 1000.0 + c}, 0.5 + c, 0.25 + c});
            level.clusters[c].refinement = c / 3;
        }
        formGroups(level, mesh.grid, {}, 3, false);
        for (std::size_t g = 0; g < level.groups.size(); ++g) {
            const int power = g % 2 == 0 ? 0 : step;
            level.groups[g].error = std::ldexp(1e3 + static_cast<double>(g), power);
            level.groups[g].attributeError = std::ldexp(2e3 + static_cast<double>(g), power);
        }
        pageCount = placeGroups(level, 3);
    }

    simplify::Mesh mesh;
    Level level;
    std::uint32_t pageCount = 0;
};

std::uint64_t decodedBytes(const Level& level, const LevelGroup& group) {
    constexpr std::uint64_t kGroupBytes = 72; // what a page of format 3 had in memory: the same groups share a page
    std::uint64_t bytes = kGroupBytes + group.clusterCount * sizeof(hierarchy::Cluster);
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c)
        bytes += level.clusters[c].vertexCount * sizeof(hierarchy::Vertex) +
                 level.clusters[c].triangleCount * sizeof(hierarchy::Triangle);
    return bytes;
}

TEST(PageLayout, FillsPagesInOrderUpToTheTargetAndNotBeyond) {
    const Placed placed;
    std::vector<std::uint64_t> bytes(placed.pageCount, 0);
    std::uint32_t page = 0;
    std::uint32_t group = 0;
    for (const LevelGroup& own : placed.level.groups) {
        ASSERT_EQ(own.place.level, 3U);
        if (own.place.page != page) {
            ASSERT_EQ(own.place.page, page + 1);
            ASSERT_GT(bytes[page] + decodedBytes(placed.level, own), hierarchy::kPageTargetBytes); // had no room
            page = own.place.page;
            group = 0;
        }
        ASSERT_EQ(own.place.group, group++);
        bytes[page] += decodedBytes(placed.level, own);
    }
    EXPECT_EQ(page + 1, placed.pageCount);
    EXPECT_GE(placed.pageCount, 3U);
    for (const std::uint64_t size : bytes)
        EXPECT_LE(size, hierarchy::kPageTargetBytes);
}

TEST(PageLayout, AGroupLargerThanAPageIsAPage) {
    Level level;
    level.clusters.resize(2);
    for (LevelCluster& cluster : level.clusters)
        cluster.vertexCount = hierarchy::kPageTargetBytes;
    level.groups.resize(2);
    for (std::uint32_t g = 0; g < 2; ++g) {
        level.groups[g].firstCluster = g;
        level.groups[g].clusterCount = 1;
    }
    EXPECT_EQ(placeGroups(level, 0), 2U);
}

TEST(PageLayout, GroupsOfAllSizesLieWhereTheFirstPageHasRoom) {
    Random random(17);
    for (int run = 0; run < 20; ++run) {
        Level level;
        level.clusters.resize(60);
        for (LevelCluster& cluster : level.clusters) {
            cluster.vertexCount = static_cast<std::uint32_t>(random.below(hierarchy::kPageTargetBytes / 40));
            cluster.triangleCount = static_cast<std::uint32_t>(random.below(hierarchy::kPageTargetBytes / 10));
        }
        for (std::uint32_t first = 0; first < level.clusters.size(); first += level.groups.back().clusterCount) {
            const auto left = static_cast<std::uint32_t>(level.clusters.size()) - first;
            LevelGroup& group = level.groups.emplace_back();
            group.firstCluster = first;
            group.clusterCount = std::min(left, 1 + static_cast<std::uint32_t>(random.below(3)));
        }
        const std::uint32_t pages = placeGroups(level, 0);
        std::uint32_t page = 0;
        std::uint64_t bytes = 0;
        for (const LevelGroup& group : level.groups) {
            const std::uint64_t own = decodedBytes(level, group);
            if (bytes > 0 && bytes + own > hierarchy::kPageTargetBytes) {
                ++page;
                bytes = 0;
            }
            bytes += own;
            ASSERT_EQ(group.place.page, page);
        }
        EXPECT_EQ(pages, page + 1);
        EXPECT_GT(pages, 5U);
    }
}

TEST(PageLayout, GroupsOfLikeErrorLieTogether) {
    Random random(5);
    for (int run = 0; run < 20; ++run) {
        Level level;
        level.clusters.resize(300);
        level.groups.resize(300);
        std::vector<int> exponents;
        const int spread = 1 << run % 8; // of the errors, in powers of two
        for (std::uint32_t g = 0; g < 300; ++g) {
            level.clusters[g].vertexCount = static_cast<std::uint32_t>(random.below(hierarchy::kPageTargetBytes / 100));
            const int exponent = static_cast<int>(random.below(static_cast<std::uint64_t>(spread) * 2)) - spread;
            const double error = std::ldexp(1.75, exponent);
            LevelGroup& group = level.groups[g];
            group.firstCluster = g;
            group.clusterCount = 1;
            group.error = g % 2 == 0 ? error : 0; // the larger of both counts
            group.attributeError = g % 2 == 0 ? error / 3 : error;
            exponents.push_back(exponent);
        }
        placeGroups(level, 0);
        std::vector<int> sorted = exponents;
        std::sort(sorted.begin(), sorted.end());
        std::vector<std::uint32_t> order(300); // the plain way to the same order
        std::iota(order.begin(), order.end(), 0U);
        const auto classOf = [&](std::uint32_t g) { return std::floor((exponents[g] - sorted[150] + 2) / 4.0); };
        std::stable_sort(
            order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return classOf(a) < classOf(b); });
        for (std::size_t i = 1; i < order.size(); ++i) {
            const GroupPlace& before = level.groups[order[i - 1]].place;
            const GroupPlace& place = level.groups[order[i]].place;
            ASSERT_TRUE(
                (place.page == before.page && place.group == before.group + 1) ||
                (place.page == before.page + 1 && place.group == 0))
                << "run " << run;
        }
    }
}

TEST(PageLayout, RootsAndGroupsWithoutAnErrorHaveAPlace) {
    Level level;
    level.clusters.resize(3);
    level.groups.resize(3); // roots
    for (std::uint32_t g = 0; g < 3; ++g) {
        level.groups[g].firstCluster = g;
        level.groups[g].clusterCount = 1;
    }
    level.groups[1].error = 0;
    EXPECT_EQ(placeGroups(level, 0), 1U);
    EXPECT_EQ(level.groups[1].place, (GroupPlace{0, 0, 0}));
    EXPECT_EQ(level.groups[0].place, (GroupPlace{0, 0, 1}));
    EXPECT_EQ(level.groups[2].place, (GroupPlace{0, 0, 2}));
}

/// The triangles of a cluster as `cornersOf` a level has them.
std::vector<Corners> cornersOf(const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
    std::vector<Corners> all;
    for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
        Corners corners;
        for (std::size_t i = 0; i < 3; ++i)
            corners.at(i) = page.vertices[cluster.firstVertex + page.triangles[cluster.firstTriangle + t][i]].position;
        std::sort(corners.begin(), corners.end());
        all.push_back(corners);
    }
    std::sort(all.begin(), all.end());
    return all;
}

void expectGroupsAsTheyWere(const Placed& placed) {
    std::vector<std::uint32_t> order(placed.level.groups.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto placeOf = [&](std::uint32_t g) {
        const GroupPlace& place = placed.level.groups[g].place;
        return std::pair(place.page, place.group);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return placeOf(a) < placeOf(b); });
    const std::vector<hierarchy::EncodedPage> pages = encodePages(placed.mesh, placed.level, 3, placed.pageCount);
    ASSERT_EQ(pages.size(), placed.pageCount);
    std::size_t next = 0; // group of the level
    for (const hierarchy::EncodedPage& encoded : pages) {
        const hierarchy::Page page = hierarchy::decodePageBytes(encoded.bytes, encoded.info);
        ASSERT_EQ(page.level, 3U);
        for (const hierarchy::Group& group : page.groups) {
            const LevelGroup& source = placed.level.groups[order[next++]];
            ASSERT_EQ(group.clusterCount, source.clusterCount);
            ASSERT_EQ(group.error, source.error);
            ASSERT_EQ(group.attributeError, source.attributeError);
            ASSERT_EQ(group.bounds.radius, source.bounds.radius);
            for (std::uint32_t i = 0; i < group.clusterCount; ++i) {
                const hierarchy::Cluster& cluster = page.clusters[group.firstCluster + i];
                const LevelCluster& from = placed.level.clusters[source.firstCluster + i];
                ASSERT_EQ(
                    cornersOf(page, cluster),
                    cornersOf(placed.mesh, placed.level, from.firstTriangle, from.triangleCount));
                const hierarchy::Refinement& refinement = page.refinements[cluster.refinement];
                const LevelRefinement& wanted = placed.level.refinements[from.refinement];
                ASSERT_EQ(refinement.error, wanted.error);
                ASSERT_EQ(refinement.attributeError, wanted.attributeError);
                ASSERT_EQ(refinement.bounds.radius, wanted.bounds.radius);
                ASSERT_EQ(refinement.group.group, wanted.place.group);
                ASSERT_EQ(refinement.group.page, provisionalId(wanted.place.level, wanted.place.page));
            }
        }
    }
    EXPECT_EQ(next, placed.level.groups.size());
}

TEST(PageLayout, EncodedPagesHoldTheGroupsAsTheyWere) {
    expectGroupsAsTheyWere(Placed());
    expectGroupsAsTheyWere(Placed(20));
}

} // namespace
} // namespace gnomon::levels
