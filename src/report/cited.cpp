#include "report/cited.h"

#include "core/formatted.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace gnomon::report {

std::string cited(double value, int digits) {
    if (!(std::abs(value) > 0) || !std::isfinite(value)) return "0";
    constexpr int kMaxDecimals = 24;
    const int decimals =
        std::clamp(digits - 1 - static_cast<int>(std::floor(std::log10(std::abs(value)))), 0, kMaxDecimals);
    std::string text = formatted("%.*f", decimals, value);
    if (text.find('.') == std::string::npos) return text;
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

double citedValue(double value) {
    return std::strtod(cited(value).c_str(), nullptr);
}

std::string citedBelow(double value, double limit) {
    constexpr int kAllDigits = 17;
    for (int digits = 3; digits < kAllDigits; ++digits)
        if (std::string text = cited(value, digits); std::strtod(text.c_str(), nullptr) <= limit) return text;
    return cited(value, kAllDigits);
}

std::string citedPercent(double share) {
    return cited(100 * share) + "%";
}

} // namespace gnomon::report
