// Writes a procedural model as a binary PLY file, on all cores and in bounded memory.
#pragma once

#include "core/progress.h"
#include "core/units.h"
#include "preprocess/make/made_model.h"

#include <string>

namespace gnomon::make {

/// The max size of a write buffer. Each thread has one buffer for vertices and one buffer for triangles.
inline constexpr Bytes kWriteBuffer = mebibytes(1);

/// Writes `model` to the file `path` as a little-endian PLY file with float positions and 32-bit indices. `comment` is
/// one line of the header. `threads` is the number of threads (0: all cores). It does not change the bytes of the file.
/// Throws Error if the file cannot be written, or if the model has too many vertices for 32-bit indices. After an error
/// no partial file remains.
MeshSize writeMadeModel(
    const MadeModel& model, const std::string& path, const std::string& comment, int threads, Progress& progress);

} // namespace gnomon::make
