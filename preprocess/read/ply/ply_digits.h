// Warns of coordinates of an ASCII PLY that have more digits than a float can store.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <string>

namespace gnomon::read {

/// Returns a warning if a float coordinate has more digits than a float can store. This means that the nearest float
/// differs by more than half a unit of the last digit. The function tests the first 65536 vertices. Returns an empty
/// string if there is no such coordinate.
std::string warningOfDigits(AsciiValues& values, const PlyElement& element, const VertexLayout& layout);

} // namespace gnomon::read
