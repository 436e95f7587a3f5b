// Writes a procedural model as a binary PLY, from all cores and in bounded memory.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/make/made_model.h"

#include <string>

namespace gnomon::make {

/// What a thread holds at most of a model's encoded bytes while it writes: one buffer of vertices, one of triangles.
inline constexpr Bytes kWriteBuffer = mebibytes(1);

/// Writes `model` to `path`: little-endian, float positions, 32-bit indices; `comment` is one line of its header. The
/// bytes do not depend on `threads` (0: all cores). Throws Error if the file cannot be written or if the model has
/// more vertices than 32 bits can number; no partial file is left.
MeshSize writeMadeModel(
    const MadeModel& model, const std::string& path, const std::string& comment, int threads, Progress& progress);

} // namespace gnomon::make
