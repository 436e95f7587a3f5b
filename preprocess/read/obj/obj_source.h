// An OBJ as a source that is read in streams: what its faces make of its vertices is all that is held.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Opens the OBJ `path`. Each line is parsed in each pass, and no position is held. Held are the stretches of the file,
/// and where faces say so for each vertex: which normal it has, which colour, and what else corners make of it.
///
/// Positions are the doubles nearest to the decimals of the text. A vertex whose corners have different normals or
/// colours comes several times. Colours of vertices come first; without them faces have the diffuse colours of their
/// materials, from libraries in `sourceRoot` (see ObjMaterials). A face without three different corners counts as not a
/// polygon. Throws Error that names the line, or where the held data needs more than `memoryLimit`.
std::unique_ptr<MeshSource> openObj(const std::string& path, Bytes memoryLimit, const std::string& sourceRoot = {});

} // namespace gnomon::read
