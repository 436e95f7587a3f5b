// The body of a binary OFF.
#pragma once

#include "preprocess/read/memory_source.h"
#include "preprocess/read/off/off_header.h"

namespace gnomon::read {

/// Reads counts, vertices and faces of a binary OFF whose keyword is `header`. Programs write it in either order of
/// bytes, and with or without the number of channels of its colour behind each face; the size of the file says which.
/// Throws Error with the byte of a defect, and for colours that take more than `memoryLimit`.
MemoryMesh readOffBinary(const InputFile& file, const OffHeader& header, Bytes memoryLimit);

} // namespace gnomon::read
