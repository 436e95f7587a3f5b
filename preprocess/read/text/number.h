// Converts text to numbers in the same way for all file formats. The result does not depend on the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace gnomon::read {

/// Returns the length of a leading '+' of `word`, which is 0 or 1. Callers skip it, because std::from_chars does not
/// accept a '+'.
inline std::size_t plusLength(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? 1 : 0;
}

/// Returns the integer value of the text `word`, which can have a sign. Returns nullopt if the whole word is not an
/// integer.
template <class Integer>
std::optional<Integer> integerIn(std::string_view word) {
    Integer value{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + plusLength(word), end, value);
    if (stop != end || error != std::errc()) return std::nullopt;
    return value;
}

/// Returns the double nearest to the decimal number in the text `word`. Returns nullopt if the whole word is not a
/// number. A number too small for a double becomes 0, and a number too large becomes infinite. The function accepts the
/// words of C ("nan", "inf") and of older Windows programs ("1.#QNAN", "-1.#IND", "1.#INF").
std::optional<double> numberIn(std::string_view word);

/// Returns true if the text `word` is a decimal number that is too large for a double. `value` must be the result of
/// numberIn for this text. Returns false for words that mean infinity, such as "inf".
inline bool isHugeNumber(std::string_view word, double value) {
    return std::isinf(value) && word.find_first_of("123456789") != std::string_view::npos &&
           word.find('#') == std::string_view::npos;
}

} // namespace gnomon::read
