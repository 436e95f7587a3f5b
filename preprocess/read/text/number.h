// Numbers in text: one rule for every format. Nothing depends on the locale.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <system_error>

namespace gnomon::read {

/// Returns the length of the sign of a word that begins with '+', which std::from_chars does not read.
inline std::size_t plusLength(std::string_view word) {
    return word.starts_with('+') && !word.starts_with("+-") ? 1 : 0;
}

/// Returns the whole number that all of `word` is, with a sign or without; nothing for any other word.
template <class Integer>
std::optional<Integer> integerIn(std::string_view word) {
    Integer value{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + plusLength(word), end, value);
    if (stop != end || error != std::errc()) return std::nullopt;
    return value;
}

/// Returns the double nearest to the decimal number that all of `word` is; nothing for a word that is no number. A
/// number too small for a double is 0, and one too large is infinite. Knows the words of C ("nan", "inf") and those of
/// older Windows programs ("1.#QNAN", "-1.#IND", "1.#INF").
std::optional<double> numberIn(std::string_view word);

/// Returns whether `word`, whose number is infinite, has digits and not the word "inf".
inline bool isHugeNumber(std::string_view word, double value) {
    return std::isinf(value) && word.find_first_of("123456789") != std::string_view::npos &&
           word.find('#') == std::string_view::npos;
}

} // namespace gnomon::read
