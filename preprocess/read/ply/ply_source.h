// Reads PLY files with any valid layout as a streamed MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// Opens a PLY file and reads its header. Triangles come from the elements `face` and `tristrips`, whose list is called
/// `vertex_indices` (or `vertex_index`), in file order. The element `vertex` has x y z, nx ny nz, and colours such as
/// red green blue alpha (see colorLayoutOf). Other data are skipped. Elements can have any order. The source needs a
/// few MiB of memory for any size of the file.
///
/// Throws Error with line or byte if the file is not a PLY, has an invalid header, is too short for its counts, or has
/// no x y z or no faces. The passes throw Error for truncated bodies, negative or invalid list counts, indices out of
/// range, and data after the last element.
std::unique_ptr<MeshSource> openPly(const std::string& path);

/// Opens a PLY like openPly. If vertices have no colours and all triangles are faces of one element, the function also
/// reads face colours. It then reads the file into memory and duplicates vertices whose faces have different colours.
/// Throws Error if this needs more memory than `memoryLimit`. The function also reads the scalar vertex properties
/// `fields`, in this order. Throws Error with the list of available properties if a field is missing or is part of
/// positions, normals or colours.
std::unique_ptr<MeshSource> openPlyWithFaceColors(
    const std::string& path, Bytes memoryLimit, const std::vector<std::string>& fields = {});

} // namespace gnomon::read
