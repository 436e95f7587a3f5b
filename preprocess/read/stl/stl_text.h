// Reads ASCII STL files.
#pragma once

#include "preprocess/read/memory_source.h"
#include "preprocess/read/text/text_stream.h"

namespace gnomon::read {

/// Reads all solids of an ASCII STL. Line ends have no meaning, except that a line end ends the name of a solid.
/// Keywords can be in upper or lower case. Throws Error with the line of a defect.
MemoryMesh readStlText(const InputFile& file);

} // namespace gnomon::read
