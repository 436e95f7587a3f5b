#include "preprocess/build/source_mesh.h"

#include "core/error.h"
#include "preprocess/read/polygon.h"

namespace gnomon::preprocess {

namespace {

void readVertices(MeshSource& source, SourceMesh& mesh, Progress& progress) {
    const MeshSummary& summary = source.summary();
    source.readVertices([&](const VertexBlock& block) {
        const std::size_t count = block.positions.size();
        mesh.positions.insert(mesh.positions.end(), block.positions.begin(), block.positions.end());
        if (summary.hasNormals) {
            mesh.normals.insert(mesh.normals.end(), block.normals.begin(), block.normals.end());
            mesh.normals.resize(mesh.positions.size(), glm::vec3(0));
        }
        if (summary.hasColors) {
            mesh.colors.insert(mesh.colors.end(), block.colors.begin(), block.colors.end());
            mesh.colors.resize(mesh.positions.size(), 0xFFFFFFFFU);
        }
        progress.advance(count);
    });
}

/// The block's triangles with the fans of its polygons replaced by right triangulations.
void appendBlock(const TriangleBlock& block, PolygonRefiner& refiner, SourceMesh& mesh) {
    std::vector<TriangleCorners> refined;
    std::span<const TriangleCorners> triangles = block.triangles;
    if (!block.polygons.empty()) {
        refined.assign(triangles.begin(), triangles.end());
        for (const PolygonRun& run : block.polygons)
            refiner.refine(std::span(refined).subspan(run.first, run.count), [&](std::uint64_t vertex) {
                return mesh.positions[vertex];
            });
        triangles = refined;
    }
    for (const TriangleCorners& t : triangles)
        mesh.triangles.push_back(
            {static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]), static_cast<std::uint32_t>(t[2])});
    mesh.notAPolygon += block.notAPolygon;
}

} // namespace

SourceMesh readSource(MeshSource& source, Progress& progress) {
    const MeshSummary& summary = source.summary();
    if (summary.vertexCount >= 0xFFFFFFFFU)
        throw Error(summary.path, "too many vertices", "fewer than 2^32", std::to_string(summary.vertexCount));
    progress.stage("read", "vertices", summary.vertexCount);
    SourceMesh mesh;
    readVertices(source, mesh, progress);
    progress.stage("read", "triangles", summary.faceCount);
    PolygonRefiner refiner;
    source.readTriangles([&](const TriangleBlock& block) {
        appendBlock(block, refiner, mesh);
        progress.advance(block.triangles.size());
    });
    return mesh;
}

} // namespace gnomon::preprocess
