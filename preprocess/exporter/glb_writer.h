// Writes a cut of a model as a binary glTF 2.0 file (.glb).
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <optional>
#include <string>

namespace gnomon::exporter {

/// Settings for writing a tile of a 3D Tiles tileset as a .glb file.
struct GlbTile {
    glm::dvec3 anchor{0}; ///< the origin of the file, in world space; positions have their own origin
    /// Enables lossless compression by EXT_meshopt_compression, which may rotate the corners of a triangle.
    bool isPacked = false;
};

/// Writes `mesh` as a .glb file. `summary` describes the model of which `mesh` is a cut. The file contains one mesh
/// with positions, normals, colours in linear light, and scalar fields. A field is an attribute with its name in
/// capitals (_QUALITY). The material is rough and double-sided.
///
/// Positions are floats relative to an origin near the model. If all world positions are exact floats, this origin is
/// zero. The node of the mesh rotates the up axis to +y, converts units to metres and adds the origin. The error of
/// survey coordinates is therefore at most 2^-24 of the model's extent. Throws Error if the file would exceed 4 GiB,
/// the limit of a .glb.
void writeGlb(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    const std::string& path,
    Progress& progress,
    const std::optional<GlbTile>& tile = std::nullopt);

} // namespace gnomon::exporter
