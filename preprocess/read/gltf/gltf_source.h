// Reads glTF 2.0 files into memory as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the default scene of the glTF file `path`. Each mesh is in memory only once, as stored in the file, and each
/// pass transforms its instances. A thousand instances therefore need little more memory than one. If a transform
/// mirrors, the order of the corners is reversed. The colour of a vertex is the material's base colour times the vertex
/// colour, as sRGB. If `bakesTextures` is true, the colour is also multiplied by the texture at the vertex. Throws
/// Error if the file is damaged, requires unsupported extensions (such as Draco compression), needs more memory than
/// `memoryLimit`, or refers to files outside `sourceRoot` (see SourceRoot).
std::unique_ptr<MeshSource> readGltf(
    const std::string& path, Bytes memoryLimit, bool bakesTextures, const std::string& sourceRoot);

} // namespace gnomon::read
