// Reads JSON files that are not trusted. The nesting depth, the number of entries and the size are limited.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon {

// The max nesting depth of a JSON document. A deeper document could overflow the stack of the parser.
constexpr std::size_t kJsonDepth = 64;
// The max number of entries of a JSON object. It is limited because the parser searches the entries linearly.
constexpr std::size_t kJsonEntries = 4096;
constexpr std::uint64_t kJsonBytes = std::uint64_t{64} << 20U; // max size; memory use is up to about 20 times as much

/// Throws Error if the JSON `text` exceeds kJsonDepth, an object exceeds kJsonEntries, or a number overflows a double.
/// The message contains `path` and the place in the file. The parser checks the syntax later.
void requireJsonLimits(const std::string& path, const std::string& text);

/// Reads the JSON document in `path`. Throws Error with the byte offset if the document exceeds kJsonBytes, kJsonDepth
/// or kJsonEntries, is not valid JSON, or contains a number that overflows a double.
nlohmann::ordered_json readJsonFile(const std::string& path);

} // namespace gnomon
