// A file of JSON, read whole.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon {

/// The document in `path`. Throws Error with the byte where it stops being JSON.
nlohmann::ordered_json readJsonFile(const std::string& path);

} // namespace gnomon
