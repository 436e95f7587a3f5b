// Writes a cut of a model as a binary PLY file.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::exporter {

/// One additional value per vertex of an exported mesh, with the name of its property in the PLY file.
struct VertexValues {
    std::string name;
    std::vector<float> values;
};

/// Writes `mesh` as a binary PLY file with the axes of the source. `summary` describes the model of which `mesh` is a
/// cut. Positions are floats if floats represent all positions exactly, and doubles otherwise. The values of a scalar
/// field follow the same rule. Normals are unit vectors (see VertexNormals). Throws Error, for example for a field name
/// that is invalid in a PLY header.
void writePly(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    std::span<const VertexValues> values,
    const std::string& path,
    Progress& progress);

} // namespace gnomon::exporter
