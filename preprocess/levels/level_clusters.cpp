#include "preprocess/levels/level_clusters.h"

namespace gnomon::levels {

void appendClusters(
    const simplify::Mesh& mesh,
    std::span<const simplify::Triangle> triangles,
    const Clustering& clustering,
    Level& level) {
    std::uint32_t begin = 0;
    for (std::size_t c = 0; c < clustering.ends.size(); ++c) {
        LevelCluster cluster;
        cluster.firstTriangle = begin;
        cluster.triangleCount = clustering.ends[c] - begin;
        cluster.vertexCount = clustering.vertexCounts[c];
        for (const simplify::Triangle& t : triangles.subspan(begin, cluster.triangleCount))
            for (const std::uint32_t v : t)
                cluster.box.add(mesh.vertices[v].position);
        level.clusters.push_back(cluster);
        begin = clustering.ends[c];
    }
}

Level firstLevel(const simplify::Mesh& mesh, const LevelOptions& options) {
    std::vector<glm::vec3> positions(mesh.positionCount);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
        const hierarchy::GridPoint& p = mesh.vertices[v].position;
        positions[mesh.positionOf[v]] = glm::dvec3(p.x, p.y, p.z);
    }
    const Clustering clustering =
        clusterTriangles(mesh.triangles, mesh.positionOf, positions, options.clusterTriangles);
    Level level;
    level.triangles.reserve(mesh.triangles.size());
    for (const std::uint32_t t : clustering.order)
        level.triangles.push_back(mesh.triangles[t]);
    level.errors.assign(level.triangles.size(), {});
    appendClusters(mesh, level.triangles, clustering, level);
    return level;
}

} // namespace gnomon::levels
