// A file of JSON, read whole: the one way in which JSON from outside gets in.
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace gnomon {

constexpr std::size_t kJsonDepth = 64;                         // what is nested deeper is made to overflow a stack
constexpr std::size_t kJsonEntries = 4096;                     // of one object; each is looked for among the others
constexpr std::uint64_t kJsonBytes = std::uint64_t{64} << 20U; // memory takes up to some 20 times as much

/// Throws Error, placed in `path`, where `text` goes deeper than kJsonDepth, has an object of more than kJsonEntries or
/// a number that no double holds. Whether it is JSON is for its parser to say.
void requireJsonLimits(const std::string& path, const std::string& text);

/// The document in `path`, at most kJsonBytes of it, kJsonDepth deep, objects of at most kJsonEntries. Throws Error
/// with the byte where it stops being that, stops being JSON or has a number that no double holds.
nlohmann::ordered_json readJsonFile(const std::string& path);

} // namespace gnomon
