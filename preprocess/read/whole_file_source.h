// OBJ, STL and OFF as a MeshSource: read whole, by OpenMesh's readers, but for large OBJs.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Whether the suffix of `path` (in any case) is one of .obj, .stl and .off.
bool isWholeFileFormat(const std::string& path);

/// Reads the file into memory. Throws Error with line or byte for what is not such a file, is truncated, has indices
/// out of range or numbers that are none; and before reading if that could take more than `memoryLimit`. An OBJ that
/// could take more than a quarter of it is streamed (obj/obj_source.h).
///
/// What OpenMesh's readers make of a file: coordinates are rounded to float; a face (or a facet) with fewer than three
/// different corners counts as not a polygon, and of an OFF a corner that repeats another of its face is left out;
/// vertices of an STL are joined where their positions are equal.
std::unique_ptr<MeshSource> readWholeFile(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
