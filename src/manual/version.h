// The output of `gnomon --version --json`.
#pragma once

#include <string>

namespace gnomon::manual {

/// Returns a JSON document with the version of Gnomon, the file formats and the compiler settings.
std::string versionJson(const std::string& version);

} // namespace gnomon::manual
