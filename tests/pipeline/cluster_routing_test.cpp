// Clusters on their way to new nodes: each arrives whole, and locked is what several nodes use, by counting all of
// them.
#include "core/random.h"
#include "preprocess/levels/level_clusters.h"
#include "preprocess/pipeline/cluster_routing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>

namespace gnomon::pipeline {
namespace {

using hierarchy::GridPoint;

/// A strip of the sheet's grid, columns [begin, end), whose first and last columns of vertices are borders.
levels::EncodedOpenClusters strip(std::uint32_t begin, std::uint32_t end, std::uint32_t rows) {
    simplify::Mesh mesh;
    const std::uint32_t width = end - begin + 1;
    for (std::uint32_t y = 0; y <= rows; ++y)
        for (std::uint32_t x = begin; x <= end; ++x) {
            mesh.vertices.push_back({{x * 10, y * 10, 0}});
            mesh.positionOf.push_back(mesh.positionCount++);
            mesh.isBorder.push_back(x == begin || x == end ? 1 : 0);
        }
    for (std::uint32_t y = 0; y < rows; ++y)
        for (std::uint32_t x = 0; x + 1 < width; ++x) {
            const std::uint32_t v = y * width + x;
            mesh.triangles.push_back({v, v + 1, v + width});
            mesh.triangles.push_back({v + 1, v + width + 1, v + width});
        }
    return levels::encodeOpenClusters(mesh, levels::firstLevel(mesh, {}));
}

using NodePositions = std::map<std::uint32_t, std::set<GridPoint>>;

void addAll(NodePositions& all, const StreamBytes& streams) {
    for (const auto& [node, bytes] : streams)
        for (const GridPoint& position : levels::positionsFrom(bytes))
            all[node].insert(position);
}

void append(std::vector<BorderUse>& uses, const StreamBytes& streams) {
    for (const auto& [stream, bytes] : streams) {
        const std::size_t first = uses.size();
        uses.resize(first + bytes.size() / sizeof(BorderUse));
        std::memcpy(uses.data() + first, bytes.data(), bytes.size());
    }
}

/// Who uses what, counted position by position.
struct Census {
    std::map<GridPoint, std::set<std::uint32_t>> users;
    std::set<GridPoint> borders;

    /// Adds what an old node left, and returns what of it each new node is to get.
    StreamBytes add(const levels::EncodedOpenClusters& left, const std::vector<std::uint32_t>& nodeOf) {
        StreamBytes expected;
        std::size_t at = levels::placeBytes(left.clusters);
        std::size_t cluster = 0;
        for (const levels::ClusterPlace& place : levels::clusterPlaces(std::span(left.bytes).first(at))) {
            const auto record = std::span(left.bytes).subspan(at, place.bytes);
            const std::uint32_t node = nodeOf[cluster++];
            for (const GridPoint& position : levels::positionsOfRecord(record))
                users[position].insert(node);
            expected[node].insert(expected[node].end(), record.begin(), record.end());
            at += place.bytes;
        }
        for (const GridPoint& position : levels::positionsFrom(std::span(left.bytes).subspan(at)))
            borders.insert(position);
        return expected;
    }

    NodePositions locked(LockCounts& counts) const {
        NodePositions all;
        for (const auto& [position, nodes] : users) {
            if (nodes.size() < 2) continue;
            ++counts.locked;
            counts.lockedBefore += borders.contains(position) ? 1 : 0;
            for (const std::uint32_t node : nodes)
                all[node].insert(position);
        }
        return all;
    }
};

TEST(ClusterRouting, LocksWhatSeveralNewNodesUseAndNothingElse) {
    Random random(3);
    for (int trial = 0; trial < 30; ++trial) {
        const auto nodeCount = static_cast<std::uint32_t>(1 + random.below(5));
        Census census;
        NodePositions locked;
        std::vector<BorderUse> uses;
        LockCounts counts;
        for (std::uint32_t old = 0; old < 4; ++old) {
            const levels::EncodedOpenClusters left = strip(20 * old, 20 * old + 20, 40);
            std::vector<std::uint32_t> nodeOf;
            for (std::uint64_t c = 0; c < left.clusters; ++c)
                nodeOf.push_back(static_cast<std::uint32_t>(random.below(nodeCount)));
            const RoutedClusters found = routed({left.bytes, nodeOf, 0, {}}, nodeCount);
            EXPECT_EQ(found.records, census.add(left, nodeOf)) << "whole, in their order";
            counts.locked += found.counts.locked;
            addAll(locked, found.locks);
            append(uses, found.borders);
            EXPECT_TRUE(found.borders.empty() || found.borders.rbegin()->first < nodeCount);
        }
        addAll(locked, sharedBorders(uses, counts));
        LockCounts expected;
        EXPECT_EQ(locked, census.locked(expected));
        EXPECT_EQ(counts.locked, expected.locked);
        EXPECT_EQ(counts.lockedBefore, expected.lockedBefore);
    }
}

TEST(ClusterRouting, OfNoClustersIsNothing) {
    const RoutedClusters none = routed({}, 3);
    EXPECT_TRUE(none.records.empty() && none.locks.empty() && none.borders.empty());
}

} // namespace
} // namespace gnomon::pipeline
