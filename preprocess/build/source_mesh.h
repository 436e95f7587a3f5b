// The whole source in memory, as it was read: the first phase of the build.
#pragma once

#include "core/progress.h"
#include "preprocess/build/mesh.h"
#include "preprocess/read/mesh_source.h"

namespace gnomon::preprocess {

/// Vertices and triangles in source order, nothing dropped. Polygons are triangulated.
struct SourceMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;    // empty, or one per vertex (zero: none)
    std::vector<std::uint32_t> colors; // empty, or one per vertex
    std::vector<Triangle> triangles;
    std::uint64_t notAPolygon = 0; // faces of fewer than three corners
};

/// Reads all of `source`. Throws Error where the source does, or if it has more vertices than 32 bits count.
SourceMesh readSource(MeshSource& source, Progress& progress);

} // namespace gnomon::preprocess
