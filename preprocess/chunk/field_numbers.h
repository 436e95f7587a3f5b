// Quantises the fields of a source's vertices to integers between the min and the max value of each field.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"

#include <vector>

namespace gnomon::chunk {

/// Returns the fields of `source` with their ranges over the used vertices, which have a `valence` above 0. It makes
/// one pass over the vertices if there are fields. Throws Error for a value or a range that is not finite, and for more
/// than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> measuredFields(
    read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress);

/// Returns the fields of `source` without ranges. Throws Error for more than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> unmeasuredFields(const read::MeshSummary& source);

/// Extends the ranges of `fields` by the used vertices of a block. Throws Error for a value that is not finite.
void addUsed(
    read::MeshSource& source,
    const read::VertexBlock& block,
    const VertexTable<std::uint8_t>& valence,
    std::vector<hierarchy::Field>& fields);

/// Completes the ranges after all vertices were added. Throws Error for a range that is not finite.
void endRanges(const std::string& path, std::vector<hierarchy::Field>& fields);

/// Packs the field values of a vertex into one word. Each value is rounded to the nearest step, so that its error is at
/// most half a step of the field.
std::uint32_t packedFields(std::span<const double> values, std::span<const hierarchy::Field> fields);

} // namespace gnomon::chunk
