#include "sun/sectioned_cut.h"

#include "raster/raster.h"
#include "render/view/grid_polygon.h"

#include <algorithm>

namespace gnomon::sun {

namespace {

using render::gridCellOf;
using render::GridPolygon;

/// Builds a new set of clusters from triangles that are added one after the other.
class CutBuilder {
public:
    void begin() { clusters_.push_back({vertexCount(), 0, triangleCount(), 0}); }

    /// Adds the triangles of a polygon to the current cluster, or to a new cluster if the current one is full.
    void add(const GridPolygon& polygon) {
        if (polygon.size < 3) return;
        const auto corners = static_cast<std::uint32_t>(polygon.size);
        if (clusters_.back().vertexCount + corners > raster::kMaxClusterVertices ||
            clusters_.back().triangleCount + corners - 2 > raster::kMaxClusterTriangles)
            begin();
        const std::uint32_t first = vertexCount();
        for (std::size_t i = 0; i < polygon.size; ++i) {
            const glm::u64vec3 p(polygon.corners.at(i));
            hierarchy::Vertex& vertex = mesh_.vertices.emplace_back();
            vertex.position = {
                static_cast<std::uint32_t>(p.x), static_cast<std::uint32_t>(p.y), static_cast<std::uint32_t>(p.z)};
        }
        for (std::uint32_t i = 2; i < corners; ++i)
            mesh_.triangles.push_back({first, first + i - 1, first + i});
        clusters_.back().vertexCount += corners;
        clusters_.back().triangleCount += corners - 2;
    }

    /// Adds an unchanged cluster.
    void addWhole(const exporter::CutMesh& mesh, const exporter::CutCluster& cluster) {
        begin();
        const std::uint32_t shift = clusters_.back().firstVertex - cluster.firstVertex;
        const auto vertices = mesh.vertices.begin() + cluster.firstVertex;
        mesh_.vertices.insert(mesh_.vertices.end(), vertices, vertices + cluster.vertexCount);
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            auto& triangle = mesh_.triangles.emplace_back(mesh.triangles[cluster.firstTriangle + t]);
            for (std::uint32_t& corner : triangle)
                corner += shift; // modulo 2^32
        }
        clusters_.back().vertexCount = cluster.vertexCount;
        clusters_.back().triangleCount = cluster.triangleCount;
    }

    exporter::UniformCut take(double error) {
        std::erase_if(clusters_, [](const exporter::CutCluster& cluster) { return cluster.triangleCount == 0; });
        exporter::UniformCut cut;
        cut.mesh = std::move(mesh_);
        cut.clusters = std::move(clusters_);
        cut.error = error;
        return cut;
    }

private:
    std::uint32_t vertexCount() const { return static_cast<std::uint32_t>(mesh_.vertices.size()); }

    std::uint32_t triangleCount() const { return static_cast<std::uint32_t>(mesh_.triangles.size()); }

    exporter::CutMesh mesh_;
    std::vector<exporter::CutCluster> clusters_;
};

} // namespace

exporter::UniformCut sectionedCut(const exporter::UniformCut& cut, std::span<const Plane> planes) {
    CutBuilder builder;
    for (const exporter::CutCluster& cluster : cut.clusters) {
        const auto vertices = cut.mesh.vertices.begin() + cluster.firstVertex;
        const bool isWhole = std::all_of(vertices, vertices + cluster.vertexCount, [&](const auto& vertex) {
            return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) {
                return plane.signedDistance(gridCellOf(vertex.position)) >= 0;
            });
        });
        if (isWhole) {
            builder.addWhole(cut.mesh, cluster);
            continue;
        }
        builder.begin();
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            GridPolygon polygon;
            for (const std::uint32_t corner : cut.mesh.triangles[cluster.firstTriangle + t])
                polygon.add(gridCellOf(cut.mesh.vertices[corner].position));
            for (const Plane& plane : planes)
                polygon = clipped(polygon, plane);
            builder.add(polygon);
        }
    }
    return builder.take(cut.error);
}

} // namespace gnomon::sun
