#include "settings/option_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>

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
std::optional<Number> number(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::optional<double> finite(std::string_view text) {
    const auto value = number<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

} // namespace

void refuse(const std::string& option, const std::string& text, const std::string& expected) {
    throw UsageError{option + ": expected " + expected + ", found '" + text + "'"};
}

std::vector<std::string> parseList(const std::string& option, const std::string& text) {
    std::vector<std::string> parts = split(text, ',');
    for (auto part = parts.begin(); part != parts.end(); ++part) {
        if (part->empty()) refuse(option, text, "values with commas between them, none of them empty");
        if (std::find(parts.begin(), part, *part) != part) refuse(option, text, "each value once");
    }
    return parts;
}

glm::dvec3 parseVector(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    if (parts.size() != 3) refuse(option, text, "x,y,z");
    glm::dvec3 vector{0};
    for (int i = 0; i < 3; ++i) {
        const auto value = finite(parts[static_cast<std::size_t>(i)]);
        if (!value) refuse(option, text, "x,y,z");
        vector[i] = *value;
    }
    return vector;
}

glm::dvec3 parseDirection(const std::string& option, const std::string& text) {
    const glm::dvec3 vector = parseVector(option, text);
    const double length = glm::length(vector);
    if (!(length > 0 && std::isfinite(length))) refuse(option, text, "a direction, of a finite length above 0");
    return vector;
}

std::array<int, 2> parseSize(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, 'x');
    if (parts.size() != 2) refuse(option, text, "WxH");
    const auto width = number<int>(parts[0]);
    const auto height = number<int>(parts[1]);
    if (!width || !height || *width < 1 || *height < 1) refuse(option, text, "WxH");
    return {*width, *height};
}

double parseNumber(const std::string& option, const std::string& text) {
    const auto value = finite(text);
    if (!value) refuse(option, text, "a number");
    return *value;
}

int parseWhole(const std::string& option, const std::string& text, int low, int high) {
    const auto value = number<int>(text);
    if (!value || *value < low || *value > high)
        refuse(option, text, "a whole number from " + std::to_string(low) + " to " + std::to_string(high));
    return *value;
}

std::optional<double> parseNumberOrAuto(const std::string& option, const std::string& text) {
    if (text == "auto") return std::nullopt;
    const auto value = finite(text);
    if (!value || !(*value > 0)) refuse(option, text, "auto or a number above 0");
    return value;
}

bool parseSwitch(const std::string& option, const std::string& text) {
    if (text == "on") return true;
    if (text != "off") refuse(option, text, "on or off");
    return false;
}

std::optional<std::uint64_t> wholeNumber(std::string_view text) {
    return number<std::uint64_t>(text);
}

Bytes parseMemory(const std::string& option, const std::string& text) {
    const auto bytes = parseBytes(text);
    if (!bytes || bytes->count == 0) refuse(option, text, "a memory size such as 512M or 2G");
    return *bytes;
}

} // namespace gnomon::settings
