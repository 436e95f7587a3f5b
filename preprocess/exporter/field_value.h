// Converts the positions and scalar fields of a cut's vertices to numbers for an exported file.
#pragma once

#include "preprocess/exporter/cut_mesh.h"

#include <algorithm>

namespace gnomon::exporter {

/// Returns the value of the scalar field with the index `i` of a vertex. `word` contains all fields of the vertex,
/// quantised and packed into bits.
inline double fieldValue(
    const hierarchy::Field& field, const hierarchy::FieldLayout& layout, std::uint32_t word, std::size_t i) {
    const double part = static_cast<double>(layout.number(word, i)) / layout.maxNumber(i);
    return field.min + part * (field.max - field.min);
}

/// Returns true if 32-bit floats represent all world positions of the mesh exactly.
inline bool fitsFloats(const CutMesh& mesh, const hierarchy::Grid& grid) {
    return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [&grid](const hierarchy::Vertex& vertex) {
        const glm::dvec3 p = grid.world(vertex.position);
        return glm::dvec3(glm::vec3(p)) == p;
    });
}

} // namespace gnomon::exporter
