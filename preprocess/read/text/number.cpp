#include "preprocess/read/text/number.h"

namespace gnomon::read {

namespace {

/// Returns the value of a word that the older C library of Windows writes for infinity or NaN, for example "-1.#IND".
std::optional<double> windowsWord(std::string_view word) {
    if (word.starts_with('-') || word.starts_with('+')) word.remove_prefix(1);
    if (!word.starts_with("1.#")) return std::nullopt;
    word.remove_prefix(3);
    if (word.starts_with("INF")) return std::numeric_limits<double>::infinity();
    const bool isNaN = word.starts_with("QNAN") || word.starts_with("SNAN") || word.starts_with("IND");
    return isNaN ? std::optional(std::numeric_limits<double>::quiet_NaN()) : std::nullopt;
}

/// Returns true if a decimal number outside the range of doubles is too large, and false if it is too small. Such a
/// number is so far from 1 that the position of its first nonzero digit relative to the decimal point is sufficient for
/// this test.
bool isTooLarge(std::string_view word) {
    const std::size_t exponentAt = word.find_first_of("eE");
    const std::string_view digits = word.substr(0, exponentAt);
    const std::size_t first = digits.find_first_of("123456789");
    const std::size_t point = std::min(digits.find('.'), digits.size());
    if (first == std::string_view::npos) return false;
    const auto place = static_cast<double>(point) - static_cast<double>(first);
    double exponent = 0;
    if (exponentAt != std::string_view::npos) {
        std::string_view text = word.substr(exponentAt + 1);
        const bool isNegative = text.starts_with('-');
        if (isNegative || text.starts_with('+')) text.remove_prefix(1);
        for (const char digit : text.substr(0, std::min<std::size_t>(text.size(), 300)))
            exponent = 10 * exponent + (digit - '0');
        if (isNegative) exponent = -exponent;
    }
    return place + exponent > 0;
}

} // namespace

std::optional<double> numberIn(std::string_view word) {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + plusLength(word), end, value);
    if (error == std::errc::result_out_of_range && stop == end)
        return std::copysign(
            isTooLarge(word) ? std::numeric_limits<double>::infinity() : 0, word.starts_with('-') ? -1 : 1);
    if (stop == end && error == std::errc()) return value;
    return windowsWord(word);
}

} // namespace gnomon::read
