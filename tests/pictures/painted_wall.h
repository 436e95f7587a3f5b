// A flat wall with painted details only: gradients, checkerboards of three sizes, and letters of five sizes.
#pragma once

#include <cstdint>
#include <string>

namespace gnomon::tests {

/// Writes a wall of `side` x `side` squares with one colour per vertex as a PLY to `path`.
void writePaintedWall(std::uint32_t side, const std::string& path);

} // namespace gnomon::tests
