// OFF as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the OFF `path`, text or binary, into memory. Throws Error with the line or byte of a defect, and before
/// reading if that could take more than `memoryLimit`.
///
/// The keyword says which values vertices have: normals (N), colours (C), texture coordinates (ST). It may be glued to
/// the counts or missing, and comments may come first. Each vertex and each face has a line, on which a colour of three
/// or four channels may follow whatever the keyword says; a file without such colours may break its lines anywhere.
/// Colours of faces count where vertices have none. Channels range to 1 if none of them exceeds 1, else to 255.
///
/// Source: Geomview's description of the format, section "OFF".
std::unique_ptr<MeshSource> readOff(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
