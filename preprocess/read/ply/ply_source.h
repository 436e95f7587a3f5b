// PLY files as a streamed MeshSource, in any valid layout.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// Opens a PLY file and reads its header. Triangles come from elements `face` and `tristrips` with a list
/// `vertex_indices` (or `vertex_index`), in file order. The element `vertex` has x y z, nx ny nz, and colours such as
/// red green blue alpha (see colorLayoutOf). Other data is skipped. Elements can have any order. Memory: a few MiB,
/// independent of the size of the file.
///
/// Throws Error with line or byte if the file is not a PLY, has a bad header, is too short for its counts, or has no x
/// y z or no faces. The passes throw Error for truncated bodies, negative or invalid list counts, indices out of range,
/// and data after the last element.
std::unique_ptr<MeshSource> openPly(const std::string& path);

/// Opens a PLY like openPly, and also reads face colours if vertices have no colours and all triangles are faces of one
/// element. It then reads the file into memory and duplicates a vertex whose faces have different colours. Throws Error
/// if this needs more than `memoryLimit`. Also reads the scalar vertex properties `fields`, in this order. Throws Error
/// with the list of available properties if one is missing or is already part of positions, normals or colours.
std::unique_ptr<MeshSource> openPlyWithFaceColors(
    const std::string& path, Bytes memoryLimit, const std::vector<std::string>& fields = {});

} // namespace gnomon::read
