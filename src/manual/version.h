// What `gnomon --version --json` prints.
#pragma once

#include <string>

namespace gnomon::manual {

/// This version, formats and how the program was compiled, as a document of JSON.
std::string versionJson(const std::string& version);

} // namespace gnomon::manual
