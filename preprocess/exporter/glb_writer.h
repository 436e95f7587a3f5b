// A cut as a binary glTF 2.0.
#pragma once

#include "core/progress.h"
#include "preprocess/exporter/cut_mesh.h"

#include <optional>
#include <string>

namespace gnomon::exporter {

/// Writes `mesh` of the model of `summary` as a .glb: one mesh with positions, normals, colours in linear light, fields
/// as attributes of their names in capitals (_QUALITY), and a dull material with two sides. Positions are floats from
/// an origin of the model's own unless all of them are floats as they are; the node turns what is up to +y, makes
/// metres of the unit and puts the origin back, so that survey coordinates lose no more than 2^-24 of the model's
/// extent. Throws Error if it would not fit the 4 GiB of a .glb.
///
/// With an `anchor`, of world space, that place becomes the file's origin instead of the source's, and positions always
/// have an origin of their own.
void writeGlb(
    const CutMesh& mesh,
    const hierarchy::ModelSummary& summary,
    const std::string& path,
    Progress& progress,
    const std::optional<glm::dvec3>& anchor = std::nullopt);

} // namespace gnomon::exporter
