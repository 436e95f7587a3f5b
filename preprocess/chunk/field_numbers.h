// Fields of a source's vertices as numbers between the least and the greatest value of each.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"

#include <vector>

namespace gnomon::chunk {

/// The fields of `source` over the vertices that triangles use, those with a `valence`: one pass over the vertices,
/// none where there are no fields. Throws Error for a value that is not finite, for a range that is not, and for more
/// than hierarchy::kMostFields.
std::vector<hierarchy::Field> measuredFields(
    read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress);

/// Those of `source`, without a range yet. Throws Error for more than hierarchy::kMostFields.
std::vector<hierarchy::Field> unmeasuredFields(const read::MeshSummary& source);

/// Widens the ranges of `fields` by the vertices of a block that triangles use. Throws Error for a value that is not
/// finite.
void addUsed(
    read::MeshSource& source,
    const read::VertexBlock& block,
    const VertexTable<std::uint8_t>& valence,
    std::vector<hierarchy::Field>& fields);

/// Ends the ranges once all vertices were added. Throws Error for a range that is not finite.
void endRanges(const std::string& path, std::vector<hierarchy::Field>& fields);

/// The word of a vertex: each value as the nearest number, half a step of its field off at most.
std::uint32_t packedFields(std::span<const double> values, std::span<const hierarchy::Field> fields);

} // namespace gnomon::chunk
