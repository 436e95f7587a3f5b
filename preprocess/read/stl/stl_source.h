// STL files, binary and ASCII, as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the STL `path` into memory. The size of the file decides whether it is binary. Corners at equal positions
/// become one vertex. A facet without three different corners counts as not a polygon. Throws Error with the line or
/// byte of a defect. Throws Error before reading if this could need more than `memoryLimit`.
///
/// A binary facet can have a colour of 15 bits, by one of two conventions. VisCAM and SolidView set bit 15 if the facet
/// has a colour, and red is in the highest bits. Magics is used if the header contains "COLOR=". There, bit 15 means
/// that the facet has the colour of the header, and red is in the lowest bits.
std::unique_ptr<MeshSource> readStl(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
