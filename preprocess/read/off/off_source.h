// Reads OFF files into memory as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the OFF file `path`, text or binary, into memory. Throws Error with the line or byte of a defect. Throws Error
/// before reading if this could need more memory than `memoryLimit`.
///
/// The file's keyword declares the attributes of the vertices: normals (N), colours (C), texture coordinates (ST). The
/// keyword can be missing or joined to the counts, and comments can precede it. Each vertex and each face has its own
/// line. A colour of three or four channels can follow on this line, whatever the keyword declares. A file without such
/// colours can break its lines anywhere. Face colours are used only if vertices have none. Full intensity is 1 if no
/// channel exceeds 1, and 255 otherwise. Source: Geomview's description of the format, section "OFF".
std::unique_ptr<MeshSource> readOff(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
