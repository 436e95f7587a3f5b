// A cut as a binary glTF 2.0.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <optional>
#include <string>

namespace gnomon::exporter {

/// How a .glb of one tile differs from that of a whole cut.
struct GlbTile {
    glm::dvec3 anchor{0};  ///< of world space: it becomes the file's origin, and positions have an origin of their own
    bool isPacked = false; ///< by EXT_meshopt_compression, without loss; the corners of a triangle may be turned
};

/// Writes `mesh` of the model of `summary` as a .glb: one mesh with positions, normals, colours in linear light, fields
/// as attributes of their names in capitals (_QUALITY), and a dull material with two sides. Positions are floats from
/// an origin of the model's own unless all of them are floats as they are; the node turns what is up to +y, makes
/// metres of the unit and puts the origin back, so that survey coordinates lose no more than 2^-24 of the model's
/// extent. Throws Error if it would not fit the 4 GiB of a .glb.
void writeGlb(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    const std::string& path,
    Progress& progress,
    const std::optional<GlbTile>& tile = std::nullopt);

} // namespace gnomon::exporter
