// The normal of each vertex of a cut as a unit vector, also where the source has none.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <glm/glm.hpp>

#include <vector>

namespace gnomon::exporter {

/// Uses 24 bytes per vertex if normals are missing, else none. The mesh and the summary must outlive it.
class VertexNormals {
public:
    VertexNormals(const CutMesh& mesh, const hierarchy::ModelSummary& summary);

    /// Returns the normal of vertex `v`: as stored, else the sum of the normals of the faces around it, weighted by
    /// area, else up.
    glm::vec3 operator[](std::size_t v) const;

private:
    const CutMesh& mesh_;
    const hierarchy::ModelSummary& summary_;
    std::vector<glm::dvec3> sums_; // empty if all vertices have normals
};

} // namespace gnomon::exporter
