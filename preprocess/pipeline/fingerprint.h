// Identifies an input without reading all of it, for resumed builds.
#pragma once

#include <string>
#include <vector>

namespace gnomon::pipeline {

/// Returns the size, the time of the last change, and a hash of evenly distributed samples of each file. The format is
/// entries "input 1 bytes 123", separated by commas. Throws Error if a file cannot be read, or can only be read once.
std::string fingerprintOf(const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
