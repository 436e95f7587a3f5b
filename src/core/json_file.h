// Reading of JSON files from outside, with limits on depth, entries and size.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon {

// The max nesting. A deeper document could overflow the stack.
constexpr std::size_t kJsonDepth = 64;
// The max number of entries of one object, because the parser searches them linearly.
constexpr std::size_t kJsonEntries = 4096;
constexpr std::uint64_t kJsonBytes = std::uint64_t{64} << 20U; // max size; memory use is up to about 20 times as much

/// Throws Error with the place in `path` if `text` exceeds kJsonDepth, an object exceeds kJsonEntries, or a number
/// overflows a double. Does not check the JSON syntax, which is the task of the parser.
void requireJsonLimits(const std::string& path, const std::string& text);

/// Reads the JSON document in `path`. Throws Error with the byte offset if the document exceeds kJsonBytes, kJsonDepth
/// or kJsonEntries, is not valid JSON, or contains a number that overflows a double.
nlohmann::ordered_json readJsonFile(const std::string& path);

} // namespace gnomon
