// Reads the data after the header of a binary OFF file.
#pragma once

#include "preprocess/read/memory_source.h"
#include "preprocess/read/off/off_header.h"

namespace gnomon::read {

/// Reads the counts, vertices and faces of a binary OFF file with the header `header`. Programs write either byte
/// order, with or without a number of colour channels after each face. The function tries these four layouts until one
/// of them reads the file exactly to its end. Throws Error with the byte of a defect. Throws Error if colours need more
/// memory than `memoryLimit`.
MemoryMesh readOffBinary(const InputFile& file, const OffHeader& header, Bytes memoryLimit);

} // namespace gnomon::read
