// An OBJ as a source that is read in streams: what its faces make of its vertices is all that is held.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// The same mesh as readWholeFile has of the OBJ `path`, but for the numbers of its vertices: each line is parsed in
/// each pass, and no position is held. Held are the stretches of the file, and where faces say so for each vertex:
/// which normal it has, which colour, and what else corners make of it. Throws Error that names the line, or where that
/// takes more than `memoryLimit`.
std::unique_ptr<MeshSource> streamObj(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
