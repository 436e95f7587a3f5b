// Quantises the fields of the source's vertices to integers between the min and the max value of each field.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"

#include <vector>

namespace gnomon::chunk {

/// Returns the fields of `source` with their ranges over the vertices that triangles use (`valence` above 0). It makes
/// one pass over the vertices if there are fields. Throws Error if a value or a range is not finite, or if there are
/// more than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> measuredFields(
    read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress);

/// Returns the fields of `source` with empty ranges. Throws Error if there are more than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> unmeasuredFields(const read::MeshSummary& source);

/// Extends the ranges of `fields` by the vertices of a block that triangles use. Throws Error if a value is not finite.
void addUsed(
    read::MeshSource& source,
    const read::VertexBlock& block,
    const VertexTable<std::uint8_t>& valence,
    std::vector<hierarchy::Field>& fields);

/// Completes the ranges after addUsed was called for all vertices. Throws Error if a range is not finite.
void endRanges(const std::string& path, std::vector<hierarchy::Field>& fields);

/// Quantises the field values of a vertex and packs them into one word. Each value is rounded to the nearest
/// quantisation step. Its error is at most half a step of the field.
std::uint32_t packedFields(std::span<const double> values, std::span<const hierarchy::Field> fields);

} // namespace gnomon::chunk
