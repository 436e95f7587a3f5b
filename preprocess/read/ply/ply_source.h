// Reads PLY files with any valid layout. The vertices and triangles are streamed in bounded memory (MeshSource).
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// Opens a PLY file and reads its header. Triangles come from the elements `face` and `tristrips`, in file order. Their
/// vertex indices are in the list `vertex_indices` (or `vertex_index`). The element `vertex` has x y z, nx ny nz, and
/// colours such as red green blue alpha (see colorLayoutOf). Other data are skipped. Elements can have any order. The
/// source needs a few MiB of memory for any size of the file.
///
/// Throws Error with line or byte if the file is not a PLY, has an invalid header, is too short for its counts, or has
/// no x y z or no faces. Reading vertices or triangles throws Error for truncated data, negative or invalid list
/// lengths, indices out of range, and data after the last element.
std::unique_ptr<MeshSource> openPly(const std::string& path);

/// Opens a PLY file like openPly, and also reads face colours and fields. Face colours are read only if vertices have
/// no colours and all triangles are faces of one element. The file is then read into memory, and vertices whose faces
/// have different colours are duplicated. Throws Error if this needs more memory than `memoryLimit`. `fields` are the
/// scalar vertex properties to read, in this order. Throws Error with the list of available properties if a field is
/// missing or is part of positions, normals or colours.
std::unique_ptr<MeshSource> openPlyWithFaceColors(
    const std::string& path, Bytes memoryLimit, const std::vector<std::string>& fields = {});

} // namespace gnomon::read
