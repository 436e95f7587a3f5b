// Reads ASCII STL files.
#pragma once

#include "preprocess/read/memory_source.h"
#include "preprocess/read/text/text_stream.h"

namespace gnomon::read {

/// Reads all solids of an ASCII STL file. Keywords can be in upper or lower case. Line ends have no meaning, except
/// that they end the name of a solid. Throws Error with the line of a defect.
MemoryMesh readStlText(const InputFile& file);

} // namespace gnomon::read
