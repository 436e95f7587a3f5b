// Quantises the fields (scalar vertex properties) of a source. The integers range from the min to the max value of each
// field.
#pragma once

#include "core/progress.h"
#include "hierarchy/model.h"
#include "hierarchy/page_fields.h"
#include "preprocess/chunk/vertex_table.h"
#include "preprocess/read/mesh_source.h"

#include <vector>

namespace gnomon::chunk {

/// Returns the fields (scalar vertex properties) of `source` with their min and max values. Only vertices of triangles
/// count, which have a `valence` above 0. The function makes one pass over the vertices if there are fields. Throws
/// Error if a value or a range is not finite, or if there are more than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> measuredFields(
    read::MeshSource& source, const VertexTable<std::uint8_t>& valence, Progress& progress);

/// Returns the fields (scalar vertex properties) of `source`, with empty value ranges. Throws Error if there are more
/// than hierarchy::kMaxFields fields.
std::vector<hierarchy::Field> unmeasuredFields(const read::MeshSummary& source);

/// Extends the value ranges of `fields` by the vertices of a block. Only vertices of triangles count. Throws Error if a
/// value is not finite.
void addUsed(
    read::MeshSource& source,
    const read::VertexBlock& block,
    const VertexTable<std::uint8_t>& valence,
    std::vector<hierarchy::Field>& fields);

/// Completes the value ranges of `fields`. The caller must first call addUsed for all vertices. Throws Error if a range
/// is not finite.
void endRanges(const std::string& path, std::vector<hierarchy::Field>& fields);

/// Quantises the field values of a vertex and packs them into one word. Each value is rounded to the nearest
/// quantisation step, so its error is at most half a step.
std::uint32_t packedFields(std::span<const double> values, std::span<const hierarchy::Field> fields);

} // namespace gnomon::chunk
