// What options are written as: vectors, sizes, lists, words; each parser names the option when it refuses.
#pragma once

#include "core/units.h"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::settings {

/// A contradiction between options, or a value that one of them cannot take.
struct UsageError {
    std::string message;
};

/// "x,y,z". Throws UsageError.
glm::dvec3 parseVector(const std::string& option, const std::string& text);

/// "x,y,z" of a length that is finite and above 0. Throws UsageError.
glm::dvec3 parseDirection(const std::string& option, const std::string& text);

/// "WxH", both at least 1. Throws UsageError.
std::array<int, 2> parseSize(const std::string& option, const std::string& text);

/// A finite number. Throws UsageError.
double parseNumber(const std::string& option, const std::string& text);

/// A whole number within [low, high]. Throws UsageError.
int parseWhole(const std::string& option, const std::string& text, int low, int high);

/// Nothing for "auto", else a number above 0. Throws UsageError.
std::optional<double> parseNumberOrAuto(const std::string& option, const std::string& text);

/// true for "on", false for "off". Throws UsageError.
bool parseSwitch(const std::string& option, const std::string& text);

/// A memory size. Throws UsageError.
Bytes parseMemory(const std::string& option, const std::string& text);

/// The parts between commas: at least one, none of them empty and no two alike. Throws UsageError.
std::vector<std::string> parseList(const std::string& option, const std::string& text);

/// A whole number from 0 to 2^64 - 1; nothing for any other text.
std::optional<std::uint64_t> wholeNumber(std::string_view text);

/// Throws UsageError: `option` was given as `text`, but `expected` was.
[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected);

} // namespace gnomon::settings
