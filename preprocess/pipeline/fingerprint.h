// What tells one input from another without reading it all: for builds that resume.
#pragma once

#include <string>
#include <vector>

namespace gnomon::pipeline {

/// For each file its size, the time of its last change, and a hash of samples taken evenly over all of it, as entries
/// "input 1 bytes 123" that commas part. Throws Error for what cannot be read, or not several times.
std::string fingerprintOf(const std::vector<std::string>& paths);

} // namespace gnomon::pipeline
