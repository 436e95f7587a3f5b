#include "preprocess/levels/group_patch.h"

#include <tbb/parallel_for.h>

#include <atomic>

namespace gnomon::levels {

using hierarchy::kNone;

PositionOwners::PositionOwners(const simplify::Mesh& mesh, const Level& level) : owners_(mesh.positionCount, kNone) {
    for (std::uint32_t position = 0; position < mesh.positionCount; ++position)
        if (mesh.isBorder[position] != 0) owners_[position] = kShared;
    // Threads mark positions for their groups in any order. The order does not affect which positions become shared.
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

GroupPatch makeGroupPatch(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const PositionOwners& owners,
    PatchNumbers& numbers) {
    GroupPatch result;
    simplify::Patch& patch = result.patch;
    numbers.vertices.begin();
    patch.triangles.reserve(triangles.size());
    for (const simplify::Triangle& t : triangles)
        patch.triangles.push_back({numbers.vertices.of(t[0]), numbers.vertices.of(t[1]), numbers.vertices.of(t[2])});
    const std::span<const std::uint32_t> vertices = numbers.vertices.ids();
    result.globalVertex.assign(vertices.begin(), vertices.end());
    patch.vertices.reserve(vertices.size());
    patch.positionOf.reserve(vertices.size());
    patch.positions.reserve(vertices.size());
    patch.isLocked.reserve(vertices.size());
    patch.fields.layout = mesh.fields.layout;
    numbers.positions.begin();
    glm::dvec3 origin(0);
    // Prefetch distance in vertices, because the vertices of a group are scattered in the mesh.
    constexpr std::size_t kAhead = 16;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i];
        if (i + kAhead < vertices.size()) {
            __builtin_prefetch(&mesh.vertices[vertices[i + kAhead]]);
            __builtin_prefetch(&mesh.positionOf[vertices[i + kAhead]]);
        }
        const hierarchy::Vertex& vertex = patch.vertices.emplace_back(mesh.vertices[v]);
        if (mesh.hasFields()) patch.fields.words.push_back(mesh.fieldsOf(v));
        const std::uint32_t position = mesh.positionOf[v];
        const std::uint32_t local = patch.positionOf.emplace_back(numbers.positions.of(position));
        if (local < patch.positions.size()) continue;
        const glm::dvec3 place(vertex.position.x, vertex.position.y, vertex.position.z);
        if (patch.positions.empty()) origin = place;
        patch.positions.push_back(place - origin);
        patch.isLocked.push_back(owners.isShared(position) ? 1 : 0);
    }
    return result;
}

} // namespace gnomon::levels
