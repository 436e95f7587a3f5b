// Writes a cut as a binary PLY file.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::exporter {

/// An additional value per vertex of a mesh.
struct VertexValues {
    std::string name;
    std::vector<float> values;
};

/// Writes `mesh` of the model of `summary` as a binary PLY, in its source's axes. Positions are floats where all of
/// them fit, else doubles; so are the values of a field. Normals are unit vectors (see VertexNormals). Throws Error, as
/// for a name that its header cannot have.
void writePly(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    std::span<const VertexValues> values,
    const std::string& path,
    Progress& progress);

} // namespace gnomon::exporter
