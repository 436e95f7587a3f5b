// A flat wall whose only detail is its paint: gradients, checkers of three sizes, and letters of five.
#pragma once

#include <cstdint>
#include <string>

namespace gnomon::tests {

/// Writes a wall of `side` x `side` squares with a colour a vertex to `path`, a PLY.
void writePaintedWall(std::uint32_t side, const std::string& path);

} // namespace gnomon::tests
