// A warning for coordinates of an ASCII PLY that have more digits than a float can store.
#pragma once

#include "preprocess/read/ply/ply_rows.h"

#include <string>

namespace gnomon::read {

/// Returns a warning if one of the first 65536 vertices has a float coordinate with more digits than a float can store:
/// the nearest float differs by more than half a unit of the last digit. Returns an empty string otherwise.
std::string warningOfDigits(AsciiValues& values, const PlyElement& element, const VertexLayout& layout);

} // namespace gnomon::read
