// What makes a page one file: its parts put into its text.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace gnomon::report {

/// `bytes` in base 64 (RFC 4648), padded.
std::string base64(std::span<const std::uint8_t> bytes);

/// Returns `data` as text that a script of a page can contain, whatever its strings contain. Their lines are printable.
std::string scriptSafe(nlohmann::json data);

/// Puts `value` in the place of the first `mark` in `text`, which has one.
void substitute(std::string& text, std::string_view mark, std::string_view value);

} // namespace gnomon::report
