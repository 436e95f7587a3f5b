// Identifies the input files of a resumed build by samples of their bytes.
#pragma once

#include <string>
#include <vector>

namespace gnomon::pipeline {

/// Returns the size, the time of the last change, and a hash of sampled bytes for each file in `paths`. The samples are
/// evenly distributed in the file. The result contains entries like "input 1 bytes 123", separated by commas. Throws
/// Error if a file cannot be read, or if it can be read only once (a pipe).
std::string fingerprintOf(const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
