// The output of `gnomon --version --json`.
#pragma once

#include <string>

namespace gnomon::manual {

/// Returns version, formats and compiler settings as a JSON document.
std::string versionJson(const std::string& version);

} // namespace gnomon::manual
