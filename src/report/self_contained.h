// Helpers that combine the parts of a page into one file.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace gnomon::report {

/// Encodes `bytes` in base64 (RFC 4648) with padding.
std::string base64(std::span<const std::uint8_t> bytes);

/// Returns `data` as text that is safe inside a script element, for all possible strings. Control characters in strings
/// are made printable.
std::string scriptSafe(nlohmann::json data);

/// Replaces the first `mark` in `text` by `value`. The mark must exist.
void substitute(std::string& text, std::string_view mark, std::string_view value);

} // namespace gnomon::report
