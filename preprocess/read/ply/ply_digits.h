// Warns the user if coordinates of an ASCII PLY file have more digits than a float can store.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <string>

namespace gnomon::read {

/// Returns a warning for the user if a coordinate that the header declares as float has too many digits. This means
/// that the nearest float differs by more than half a unit of the last digit. The function tests the first 65536
/// vertices. Returns an empty string if no coordinate has too many digits.
std::string warningOfDigits(AsciiValues& values, const PlyElement& element, const VertexLayout& layout);

} // namespace gnomon::read
