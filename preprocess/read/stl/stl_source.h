// STL, binary and ASCII, as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the STL `path` into memory. The size of the file says whether it is binary. Corners at equal positions are one
/// vertex; a facet without three different corners counts as not a polygon. Throws Error with the line or byte of a
/// defect, and before reading if that could take more than `memoryLimit`.
///
/// A binary facet may have a colour of 15 bits. In the manner of VisCAM and SolidView bit 15 says that it has one, and
/// red is in the highest bits. In the manner of Magics, which a header with "COLOR=" announces, bit 15 says that it has
/// none but that of the header, and red is in the lowest bits.
std::unique_ptr<MeshSource> readStl(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
