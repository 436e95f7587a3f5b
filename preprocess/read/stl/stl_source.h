// Reads binary and ASCII STL files into memory as a MeshSource.
#pragma once

#include "core/units.h"
#include "preprocess/read/mesh_source.h"

#include <memory>
#include <string>

namespace gnomon::read {

/// Reads the STL file `path` into memory. The size of the file determines whether it is binary. Corners at equal
/// positions become one vertex. A facet without three different corners is skipped and counted. Throws Error with the
/// line or byte of a defect. Throws Error before reading if this could need more memory than `memoryLimit`.
///
/// A facet of a binary file can have a colour of 15 bits. There are two conventions:
/// - VisCAM and SolidView: bit 15 means that the facet has its own colour. Red is in the highest bits.
/// - Magics, if the header contains "COLOR=": bit 15 means that the facet has the colour in the header. Red is in the
///   lowest bits.
std::unique_ptr<MeshSource> readStl(const std::string& path, Bytes memoryLimit);

} // namespace gnomon::read
