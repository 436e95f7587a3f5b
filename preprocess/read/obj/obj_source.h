// OBJ files as a streamed MeshSource. Memory holds only the data that faces define per vertex.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Opens the OBJ `path`. Each pass parses the lines again, and positions are not stored. Memory holds the ranges of
/// lines and the colours of `vc` lines. It also holds the normals and colours that faces give to vertices.
///
/// Positions are the doubles nearest to the decimals of the text. A vertex whose corners have different normals or
/// colours is duplicated. Vertex colours have priority; without them, faces have the diffuse colours of their
/// materials, from libraries in `sourceRoot` (see ObjMaterials). A face without three different corners counts as not a
/// polygon. Throws Error with the line of a defect. Throws Error if the stored data needs more than `memoryLimit`.
std::unique_ptr<MeshSource> openObj(const std::string& path, Bytes memoryLimit, const std::string& sourceRoot = {});

} // namespace gnomon::read
