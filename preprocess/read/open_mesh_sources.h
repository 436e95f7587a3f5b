// The way in: paths become one MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// What becomes of a texture: its colours at the vertices, or nothing.
enum class Textures { Bake, Off };

/// Opens every path and joins them into one model: vertices and triangles follow one another in the order of `paths`,
/// indices are shifted accordingly. A block of a joined model holds vertices of one input only, so it lacks normals or
/// colours where that input has none, even if the summary has them because another does.
///
/// PLY files and .glb are known by their first bytes, whatever their name; the others by their suffix. PLY and OBJ are
/// streamed, but for a PLY whose faces have colours; that, glTF, STL and OFF are read whole and throw Error if that
/// could take more than `memoryLimit`. All errors name the file.
///
/// `fields` are scalar properties of the vertices to read besides, which every input must be a PLY for and must have.
/// `sourceRoot` is the folder that buffers, images and material libraries may come from; if it is empty, the folder of
/// each input is (see SourceRoot).
std::unique_ptr<MeshSource> openMeshSources(
    const std::vector<std::string>& paths,
    Bytes memoryLimit,
    const std::vector<std::string>& fields = {},
    Textures textures = Textures::Bake,
    const std::string& sourceRoot = {});

} // namespace gnomon::read
