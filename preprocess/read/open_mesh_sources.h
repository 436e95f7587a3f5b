// Opens mesh files of all supported formats as one MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// The treatment of textures. Bake samples them at the vertices, and Off ignores them.
enum class Textures { Bake, Off };

/// Opens all files `paths` and joins them to one source. Vertices and triangles are in the order of `paths`, and
/// indices are shifted accordingly. A block has vertices of only one input. The joined source has normals only if all
/// inputs have normals. It has colours if any input has colours. Blocks of inputs without colours then have no colours.
///
/// PLY and .glb are detected by the first bytes of the file, the other formats by the suffix of the name. PLY and OBJ
/// are streamed, except PLY files with face colours. Such PLY files, glTF, STL and OFF are read into memory. The
/// function throws Error if this could need more memory than `memoryLimit`. All errors name the file.
///
/// `fields` are scalar vertex properties to read in addition. Each input must then be a PLY that has these properties.
/// Buffers, images and material libraries must be in the folder `sourceRoot`. If `sourceRoot` is empty, they must be in
/// the folder of the input (see SourceRoot).
std::unique_ptr<MeshSource> openMeshSources(
    const std::vector<std::string>& paths,
    Bytes memoryLimit,
    const std::vector<std::string>& fields = {},
    Textures textures = Textures::Bake,
    const std::string& sourceRoot = {});

} // namespace gnomon::read
