#include "settings/value_colors.h"

namespace gnomon::settings {

namespace {

std::optional<std::array<double, 2>> rangeOf(const std::string& text) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos) return std::nullopt;
    const auto low = anyNumber().read(text.substr(0, comma));
    const auto high = anyNumber().read(text.substr(comma + 1));
    return low && high && *low < *high ? std::optional(std::array{*low, *high}) : std::nullopt;
}

} // namespace

Codec<std::array<double, 2>> valueRange() {
    return {
        rangeOf,
        [](const std::array<double, 2>& range) { return shortest(range[0]) + "," + shortest(range[1]); },
        "LO,HI, two numbers of which the first is less"};
}

} // namespace gnomon::settings
