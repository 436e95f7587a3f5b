// Conversion of text to numbers, with the same rules for all formats. The result does not depend on the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace gnomon::read {

/// Returns 1 if `word` begins with a '+', which std::from_chars does not accept, else 0.
inline std::size_t plusLength(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? 1 : 0;
}

/// Returns the integer `word`, with or without a sign. Returns nothing if the whole word is not an integer.
template <class Integer>
std::optional<Integer> integerIn(std::string_view word) {
    Integer value{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + plusLength(word), end, value);
    if (stop != end || error != std::errc()) return std::nullopt;
    return value;
}

/// Returns the double nearest to the decimal number `word`. Returns nothing if the whole word is not a number. A number
/// too small for a double becomes 0, and a number too large becomes infinite. Accepts the words of C ("nan", "inf") and
/// of older Windows programs ("1.#QNAN", "-1.#IND", "1.#INF").
std::optional<double> numberIn(std::string_view word);

/// Returns whether `word` is a decimal number that is too large for a double. `value` is its value from numberIn.
/// Returns false for words that mean infinity, such as "inf".
inline bool isHugeNumber(std::string_view word, double value) {
    return std::isinf(value) && word.find_first_of("123456789") != std::string_view::npos &&
           word.find('#') == std::string_view::npos;
}

} // namespace gnomon::read
