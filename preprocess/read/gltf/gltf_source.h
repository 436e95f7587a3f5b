// glTF 2.0 as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the default scene: its meshes are held once, as they are stored, and placed anew in each pass, so that a
/// thousand instances cost no more memory than one. Where a placement mirrors, triangles turn their corners.
///
/// Vertices have the material's base colour, times that of the vertex, as sRGB; `bakesTextures` multiplies the texture
/// in as it is at the vertex. Throws Error for what is damaged, needs extensions that are not read (Draco's among
/// them), takes more than `memoryLimit`, or refers to files outside of `sourceRoot` (see SourceRoot).
std::unique_ptr<MeshSource> readGltf(
    const std::string& path, Bytes memoryLimit, bool bakesTextures, const std::string& sourceRoot);

} // namespace gnomon::read
