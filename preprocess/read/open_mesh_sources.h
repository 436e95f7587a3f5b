// Opens one or more mesh files of any supported format as one input mesh (MeshSource).
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// Selects how textures are read: Bake samples their colours at the vertices, and Off ignores textures.
enum class Textures { Bake, Off };

/// Opens all files `paths` and joins them to one mesh. Vertices and triangles have the order of `paths`, and vertex
/// indices are shifted accordingly. A block has vertices of only one file. The joined mesh has normals only if all
/// files have normals. It has colours if any file has colours. The blocks of files without colours then have no
/// colours.
///
/// PLY and .glb are detected by the first bytes of the file, and the other formats by the suffix of the name. PLY and
/// OBJ are streamed, except PLY files with face colours. Such PLY files, glTF, STL and OFF are read into memory. The
/// function throws Error if this could need more memory than `memoryLimit`. All errors name the file.
///
/// `fields` are the names of scalar vertex properties that are also read. Each file must then be a PLY that has these
/// properties. Buffers, images and material libraries must be in the folder `sourceRoot`. If `sourceRoot` is empty,
/// they must be in the folder of the file that refers to them (see SourceRoot).
std::unique_ptr<MeshSource> openMeshSources(
    const std::vector<std::string>& paths,
    Bytes memoryLimit,
    const std::vector<std::string>& fields = {},
    Textures textures = Textures::Bake,
    const std::string& sourceRoot = {});

} // namespace gnomon::read
