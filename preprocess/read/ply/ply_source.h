// PLY as a MeshSource: streamed, in any legal layout.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>
#include <vector>

namespace gnomon::read {

/// Opens a PLY file and reads its header. Any element named `face` or `tristrips` with a list `vertex_indices` (or
/// `vertex_index`) gives triangles, in file order; `vertex` gives x y z, nx ny nz, red green blue alpha (or diffuse_*).
/// Everything else is passed over. Elements may come in any order. Memory: a few MiB, whatever the file's size.
///
/// Throws Error with line or byte: no PLY, a bad header, counts that the file is too short for, no x y z, no faces.
/// The passes throw for truncated bodies, list counts that are negative or absurd, indices out of range, and data after
/// the last element.
std::unique_ptr<MeshSource> openPly(const std::string& path);

/// The same with the colours of faces where vertices have none and all triangles are faces of one element: read whole,
/// a vertex split where its faces have different colours. Throws Error where that takes more than `memoryLimit`.
/// Scalar properties of the vertices named in `fields` are read too, in that order; Error lists those that there are
/// where one of them is not there, or is kept anyway.
std::unique_ptr<MeshSource> openPlyWithFaceColors(
    const std::string& path, Bytes memoryLimit, const std::vector<std::string>& fields = {});

} // namespace gnomon::read
