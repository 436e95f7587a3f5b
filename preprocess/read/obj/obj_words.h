// Words of an OBJ's lines: numbers, and corners of faces.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace gnomon::read {

/// The number that `word` is, whole, with a sign or without.
template <class Number>
std::optional<Number> numberIn(std::string_view word) {
    Number value{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + (word.starts_with('+') ? 1 : 0), end, value);
    if (stop != end || error != std::errc()) return std::nullopt;
    return value;
}

/// As the file has them: from 1 on, or below 0 back from the last one so far; 0 for none.
struct ObjIndices {
    std::int32_t vertex = 0;
    std::int32_t normal = 0;
};

/// V, V/T, V//N or V/T/N; V is the one that must be there, and none may be 0.
inline std::optional<ObjIndices> cornerIn(std::string_view word) {
    ObjIndices corner;
    for (int part = 0; part < 3; ++part) {
        const std::size_t slash = word.find('/');
        const std::string_view text = word.substr(0, slash);
        const bool mayBeEmpty = part == 1 || (part == 2 && slash == std::string_view::npos);
        const std::int32_t index = numberIn<std::int32_t>(text).value_or(0);
        if (index == 0 && !(text.empty() && mayBeEmpty)) return std::nullopt;
        if (part == 0) corner.vertex = index;
        if (part == 2) corner.normal = index;
        if (slash == std::string_view::npos) return corner;
        word = word.substr(slash + 1);
    }
    return std::nullopt;
}

} // namespace gnomon::read
