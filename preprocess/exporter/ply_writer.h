// Writes a cut as a binary PLY file.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::exporter {

/// An additional value per vertex of a mesh, with its name in the file.
struct VertexValues {
    std::string name;
    std::vector<float> values;
};

/// Writes `mesh` as a binary PLY file in the axes of the source. `summary` describes the model of the mesh. Positions
/// are floats if floats represent all positions exactly, and doubles otherwise. The values of a field follow the same
/// rule. Normals are unit vectors (see VertexNormals). Throws Error, for example for a field name that is invalid in a
/// PLY header.
void writePly(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    std::span<const VertexValues> values,
    const std::string& path,
    Progress& progress);

} // namespace gnomon::exporter
