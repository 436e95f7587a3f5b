#include "preprocess/read/ply/ply_digits.h"

#include "preprocess/read/text/number.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::read {

namespace {

/// Returns the value of one unit in the last digit of a decimal number, for example 0.01 for "1.25".
double lastDigitOf(std::string_view text) {
    const std::size_t exponentAt = text.find_first_of("eE");
    const std::string_view digits = text.substr(0, exponentAt);
    const std::size_t point = digits.find('.');
    const auto decimals = point == std::string_view::npos ? 0 : static_cast<std::int64_t>(digits.size() - point - 1);
    std::int64_t exponent = 0;
    if (exponentAt != std::string_view::npos)
        exponent = integerIn<std::int32_t>(text.substr(exponentAt + 1)).value_or(0);
    return numberIn("1e" + std::to_string(exponent - decimals)).value_or(0);
}

bool losesDigits(std::string_view text) {
    const double value = numberIn(text).value_or(0);
    const double rounding = std::abs(static_cast<double>(static_cast<float>(value)) - value);
    // If a program printed these digits from a float, the float differs from them by at most half a unit of the last
    // digit.
    constexpr double kHalf = 0.5001;
    const bool isTiny = std::abs(value) < static_cast<double>(std::numeric_limits<float>::min());
    return !isTiny && rounding > 0 && std::isfinite(rounding) && rounding > kHalf * lastDigitOf(text);
}

} // namespace

std::string warningOfDigits(AsciiValues& values, const PlyElement& element, const VertexLayout& layout) {
    constexpr std::uint64_t kRows = 65536;
    const auto first = layout.property.begin();
    values.beginElement(element);
    for (std::uint64_t row = 0; row < std::min(element.count, kRows); ++row) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            const bool isCoordinate = std::find(first, first + kNormal, static_cast<int>(i)) != first + kNormal;
            if (!isCoordinate || property.type != PlyType::Float32) {
                skipProperty(values, property);
                continue;
            }
            values.real(property.type);
            if (losesDigits(values.lastWord()))
                return "warning: a coordinate of type float has more digits than a float holds, first " +
                       quotedForMessage(values.lastWord()) + " of vertex " + std::to_string(row) +
                       "; digits are lost, unless x, y and z are declared as double";
        }
        values.endRow();
    }
    return {};
}

} // namespace gnomon::read
