// Returns a unit normal for each vertex of a cut, also for vertices without a normal in the source.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::exporter {

/// The unit normals of a mesh whose model has normals (ModelSummary::hasNormals). If at least one vertex has no normal,
/// the object uses 24 bytes per vertex. The mesh and the summary must outlive this object.
class VertexNormals {
public:
    VertexNormals(const CutMesh& mesh, const hierarchy::ModelSummary& summary);

    /// Returns the unit normal of the vertex with the index `v`. If the vertex has no stored normal, the result is the
    /// area-weighted mean of the normals of its faces. If this mean is zero, the result is the up direction.
    glm::vec3 operator[](std::size_t v) const;

private:
    const CutMesh& mesh_;
    const hierarchy::ModelSummary& summary_;
    std::vector<glm::dvec3> sums_; // sums of face normals; empty if all vertices have normals
};

} // namespace gnomon::exporter
