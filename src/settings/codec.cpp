#include "settings/codec.h"

#include "hierarchy/world_frame.h"

#include <charconv>
#include <cmath>
#include <utility>

namespace gnomon::settings {

namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t start = 0;
    for (;;) {
        const std::size_t end = text.find(separator, start);
        parts.push_back(text.substr(start, end - start));
        if (end == std::string::npos) return parts;
        start = end + 1;
    }
}

template <class Number>
std::optional<Number> numberOf(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<double> finite(std::string_view text) {
    const auto value = numberOf<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<glm::dvec3> vectorOf(const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3) return std::nullopt;
    glm::dvec3 result{0};
    for (int i = 0; i < 3; ++i) {
        const auto value = finite(parts[static_cast<std::size_t>(i)]);
        if (!value) return std::nullopt;
        result[i] = *value;
    }
    return result;
}

std::string vectorText(const glm::dvec3& vector) {
    return shortest(vector.x) + "," + shortest(vector.y) + "," + shortest(vector.z);
}

/// Writes `number` with the largest suffix that divides it. The suffixes mean powers of `step`, so 2000000 is "2M" for
/// a step of 1000.
std::string withSuffix(std::uint64_t number, std::uint64_t step, std::string_view suffixes) {
    std::size_t steps = 0;
    while (steps < suffixes.size() && number > 0 && number % step == 0) {
        number /= step;
        ++steps;
    }
    return std::to_string(number) + (steps > 0 ? std::string(1, suffixes[steps - 1]) : std::string());
}

} // namespace

void refuse(const std::string& option, const std::string& text, const std::string& expected) {
    throw UsageError{option, option + ": expected " + expected + ", found '" + text + "'"};
}

std::string shortest(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
    return {text.data(), end};
}

Codec<double> number(std::string expected, bool (*isAllowed)(double)) {
    return {
        [isAllowed](const std::string& text) {
            const std::optional<double> value = finite(text);
            return value && isAllowed(*value) ? value : std::nullopt;
        },
        shortest,
        std::move(expected)};
}

Codec<double> anyNumber() {
    return number("a number", [](double) { return true; });
}

Codec<double> positiveNumber() {
    return number("a number above 0", [](double value) { return value > 0; });
}

Codec<double> distance() {
    return number("a distance from 1e-15 to 1e15", [](double value) { return value >= 1e-15 && value <= 1e15; });
}

Codec<int> whole(int low, int high) {
    return {
        [low, high](const std::string& text) {
            const std::optional<int> value = numberOf<int>(text);
            return value && *value >= low && *value <= high ? value : std::nullopt;
        },
        [](int value) { return std::to_string(value); },
        "a whole number from " + std::to_string(low) + " to " + std::to_string(high)};
}

Codec<std::uint64_t> seed() {
    return {
        [](const std::string& text) { return numberOf<std::uint64_t>(text); },
        [](std::uint64_t value) { return std::to_string(value); },
        "a whole number from 0 to 2^64 - 1"};
}

Codec<bool> onOff() {
    static constexpr std::array kWords = {Word<bool>{true, "on"}, Word<bool>{false, "off"}};
    return oneOf(kWords);
}

Codec<glm::dvec3> vector() {
    return {vectorOf, vectorText, "x,y,z"};
}

Codec<glm::dvec3> direction() {
    return {
        [](const std::string& text) {
            const std::optional<glm::dvec3> value = vectorOf(text);
            const double length = value ? glm::length(*value) : 0;
            return length > 0 && std::isfinite(length) ? value : std::nullopt;
        },
        vectorText,
        "x,y,z, a direction of a finite length above 0"};
}

Codec<glm::dvec3> upDirection() {
    return {
        [](const std::string& text) -> std::optional<glm::dvec3> {
            if (text == "auto") return kAutoUp;
            if (const auto axis = hierarchy::upAxisNamed(text)) return axis->direction;
            return direction().read(text);
        },
        [](const glm::dvec3& value) {
            for (const char* const name : {"x", "y", "z", "-x", "-y", "-z"})
                if (hierarchy::upAxisNamed(name)->direction == value) return std::string(name);
            return value == kAutoUp ? std::string("auto") : direction().write(value);
        },
        "auto, x, y, z, -x, -y, -z or " + direction().expected};
}

Codec<std::array<int, 2>> size(const std::string& limit, bool (*isAllowed)(const std::array<int, 2>& size)) {
    using Size = std::array<int, 2>;
    return {
        [isAllowed](const std::string& text) -> std::optional<Size> {
            const std::vector<std::string> parts = split(text, 'x');
            if (parts.size() != 2) return std::nullopt;
            const auto width = numberOf<int>(parts[0]);
            const auto height = numberOf<int>(parts[1]);
            if (!width || !height || *width < 1 || *height < 1) return std::nullopt;
            const Size value{*width, *height};
            return isAllowed(value) ? std::optional(value) : std::nullopt;
        },
        [](const Size& value) { return std::to_string(value[0]) + "x" + std::to_string(value[1]); },
        "WxH, " + limit};
}

Codec<std::uint64_t> count() {
    return {
        [](const std::string& text) {
            const std::optional<std::uint64_t> value = parseCount(text);
            return value && *value > 0 ? value : std::nullopt;
        },
        [](std::uint64_t value) { return withSuffix(value, 1000, "kMG"); },
        "a count such as 500k or 2M"};
}

Codec<Bytes> memory() {
    return {
        [](const std::string& text) {
            const std::optional<Bytes> value = parseBytes(text);
            return value && value->count > 0 ? value : std::nullopt;
        },
        [](const Bytes& value) { return withSuffix(value.count, 1024, "kMG"); },
        "a memory size such as 512M or 2G"};
}

Codec<std::string> text() {
    return {
        [](const std::string& value) { return std::optional(value); },
        [](const std::string& value) { return value; },
        "text"};
}

std::vector<std::string> listItems(const std::string& option, const std::string& list) {
    std::vector<std::string> items = split(list, ',');
    for (const std::string& item : items)
        if (item.empty()) refuse(option, list, "values with commas between them, none of them empty");
    return items;
}

} // namespace gnomon::settings
