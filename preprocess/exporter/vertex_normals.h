// The unit normal of each vertex of a cut, also for vertices without a normal in the source.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::exporter {

/// The normals of a mesh whose model has normals (ModelSummary::hasNormals). The object uses 24 bytes per vertex if a
/// vertex has no normal. The mesh and the summary must outlive it.
class VertexNormals {
public:
    VertexNormals(const CutMesh& mesh, const hierarchy::ModelSummary& summary);

    /// Returns the normal of vertex `v`. If the vertex has no stored normal, the result is the area-weighted mean of
    /// the normals of its faces. If this mean is zero, the result is the up direction.
    glm::vec3 operator[](std::size_t v) const;

private:
    const CutMesh& mesh_;
    const hierarchy::ModelSummary& summary_;
    std::vector<glm::dvec3> sums_; // empty if all vertices have normals
};

} // namespace gnomon::exporter
