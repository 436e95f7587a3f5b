// Reads OBJ files. The vertices and triangles are streamed (MeshSource).
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Opens the OBJ file `path`. Each pass parses the lines again, and positions are not stored. The source stores only
/// the ranges of lines, the colours of `vc` lines, and the normals and colours that faces give to vertices. Positions
/// are the doubles nearest to the decimal numbers of the text.
///
/// A vertex whose corners have different normals or colours is duplicated. Vertex colours have priority. Without vertex
/// colours, faces have the diffuse colours of their materials, from libraries in `sourceRoot` (see ObjMaterials). A
/// face without three different corners is skipped and counted. Throws Error with the line of a defect. Throws Error if
/// the stored data need more memory than `memoryLimit`.
std::unique_ptr<MeshSource> openObj(const std::string& path, Bytes memoryLimit, const std::string& sourceRoot = {});

} // namespace gnomon::read
