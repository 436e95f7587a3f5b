// Writes a cut as a binary glTF 2.0 file.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <optional>
#include <string>

namespace gnomon::exporter {

/// Settings for a .glb file that is a tile of a tileset, instead of a whole cut.
struct GlbTile {
    glm::dvec3 anchor{0};  ///< world space; the origin of the file; positions have their own origin
    bool isPacked = false; ///< lossless compression by EXT_meshopt_compression; may rotate the corners of a triangle
};

/// Writes `mesh` as a .glb file. `summary` describes the model of the mesh. The file contains one mesh with positions,
/// normals, colours in linear light, and fields. A field is an attribute with its name in capitals (_QUALITY). The
/// material is rough and double-sided.
///
/// Positions are floats relative to an origin near the model. If all world positions are exact floats, this origin is
/// zero. The node rotates the up axis to +y, converts units to metres and adds the origin. The error of survey
/// coordinates is therefore at most 2^-24 of the model's extent. Throws Error if the file would exceed the limit of a
/// .glb, 4 GiB.
void writeGlb(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    const std::string& path,
    Progress& progress,
    const std::optional<GlbTile>& tile = std::nullopt);

} // namespace gnomon::exporter
