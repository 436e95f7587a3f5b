#include "preprocess/build/group_patch.h"

#include "core/index_table.h"

#include <tbb/parallel_for.h>

#include <atomic>

namespace gnomon::preprocess {

using hierarchy::kNone;

PositionOwners::PositionOwners(const Mesh& mesh, const Level& level) : owners_(mesh.positionCount, kNone) {
    for (std::uint32_t position = 0; position < mesh.positionCount; ++position)
        if (mesh.isBorder(position)) owners_[position] = kShared;
    // Which group comes first depends on the threads, whether a position ends as shared does not.
    const auto claim = [&](std::uint32_t position, std::uint32_t group) {
        const std::atomic_ref<std::uint32_t> owner(owners_[position]);
        std::uint32_t found = owner.load(std::memory_order_relaxed);
        if (found == kNone && owner.compare_exchange_strong(found, group, std::memory_order_relaxed)) return;
        if (found != group && found != kShared) owner.store(kShared, std::memory_order_relaxed);
    };
    tbb::parallel_for(std::size_t{0}, level.groups.size(), [&](std::size_t g) {
        const LevelGroup& group = level.groups[g];
        for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
            const LevelCluster& cluster = level.clusters[c];
            for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t)
                for (const std::uint32_t v : level.triangles[t])
                    claim(mesh.positionOf[v], static_cast<std::uint32_t>(g));
        }
    });
}

GroupPatch makeGroupPatch(const Mesh& mesh, std::span<const Triangle> triangles, const PositionOwners& owners) {
    GroupPatch result;
    Patch& patch = result.patch;
    std::vector<std::uint32_t> globalPosition;
    IndexTable vertexTable(triangles.size() * 3);
    IndexTable positionTable(triangles.size() * 3);
    glm::dvec3 origin(0);
    const auto localPosition = [&](std::uint32_t position, const GridPoint& point) {
        const auto next = static_cast<std::uint32_t>(globalPosition.size());
        const std::uint32_t local = positionTable.findOrInsert(
            mix64(position), next, [&](std::uint32_t other) { return globalPosition[other] == position; });
        if (local == next) {
            const glm::dvec3 place(point.x, point.y, point.z);
            if (next == 0) origin = place;
            globalPosition.push_back(position);
            patch.positions.push_back(place - origin);
            patch.isLocked.push_back(owners.isShared(position) ? 1 : 0);
        }
        return local;
    };
    patch.triangles.reserve(triangles.size());
    for (const Triangle& t : triangles) {
        Triangle corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto next = static_cast<std::uint32_t>(result.globalVertex.size());
            corners[i] = vertexTable.findOrInsert(
                mix64(t[i]), next, [&](std::uint32_t other) { return result.globalVertex[other] == t[i]; });
            if (corners[i] != next) continue;
            const Vertex& vertex = mesh.vertices[t[i]];
            result.globalVertex.push_back(t[i]);
            patch.vertices.push_back(vertex);
            patch.positionOf.push_back(localPosition(mesh.positionOf[t[i]], vertex.position));
        }
        patch.triangles.push_back(corners);
    }
    return result;
}

} // namespace gnomon::preprocess
