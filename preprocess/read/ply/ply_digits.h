// Coordinates of an ASCII PLY that have more digits than their type holds.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <string>

namespace gnomon::read {

/// Returns a warning if a coordinate of type float among the first 65536 vertices is written with more digits than a
/// float holds: the float nearest to it differs by more than half a unit of its last digit. Empty without one.
std::string warningOfDigits(AsciiValues& values, const PlyElement& element, const VertexLayout& layout);

} // namespace gnomon::read
