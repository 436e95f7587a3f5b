#include "settings/value_colors.h"

#include "core/printable.h"

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

ValueColors valueColors(const ValueColorWords& words) {
    ValueColors colors;
    if (!words.by.empty()) {
        const std::optional<ColorBy> by = valueOf(kColorBys, words.by);
        colors.by = by.value_or(ColorBy::Field);
        if (!by) colors.field = words.by;
    }
    if (!words.map.empty()) colors.map = parsed(oneOf(plan::kColorMaps), "--colormap", words.map);
    if (!words.range.empty()) colors.range = parsed(valueRange(), "--color-range", words.range);
    const bool hasScale = colors.by != ColorBy::None && colors.by != ColorBy::Vertex;
    if (!hasScale && colors.range)
        throw UsageError{"--color-range", "--color-range needs --color-by height, slope, error or a field"};
    return colors;
}

std::string nameOf(const ValueColors& colors) {
    return colors.by == ColorBy::Field ? printable(colors.field) : std::string(wordOf(kColorBys, colors.by));
}

Codec<std::array<double, 2>> valueRange() {
    return {
        rangeOf,
        [](const std::array<double, 2>& range) { return shortest(range[0]) + "," + shortest(range[1]); },
        "LO,HI, two numbers of which the first is less"};
}

} // namespace gnomon::settings
