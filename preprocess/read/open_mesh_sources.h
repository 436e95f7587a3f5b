// Opens mesh files of all supported formats as one MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// The treatment of textures: sample them at the vertices, or ignore them.
enum class Textures { Bake, Off };

/// Opens all `paths` and joins them to one source. Vertices and triangles follow one another in the order of `paths`,
/// and indices are shifted accordingly. A block has vertices of one input only. The joined source has normals only if
/// all inputs have normals. It has colours if any input has colours; blocks of other inputs then have none.
///
/// Detects PLY and .glb by their first bytes, the other formats by the suffix of the name. PLY and OBJ are streamed,
/// except a PLY whose faces have colours. Such a PLY, glTF, STL and OFF are read into memory; throws Error if this
/// could need more than `memoryLimit`. All errors name the file.
///
/// `fields` are scalar vertex properties to read in addition; every input must be a PLY that has them. Buffers, images
/// and material libraries must be in the folder `sourceRoot`, or in the folder of the input if `sourceRoot` is empty
/// (see SourceRoot).
std::unique_ptr<MeshSource> openMeshSources(
    const std::vector<std::string>& paths,
    Bytes memoryLimit,
    const std::vector<std::string>& fields = {},
    Textures textures = Textures::Bake,
    const std::string& sourceRoot = {});

} // namespace gnomon::read
