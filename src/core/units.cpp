#include "core/units.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>

namespace gnomon {

namespace {

/// Parses a number with an optional suffix k, M, G or T, and scales it by the matching power of `base`.
std::optional<std::uint64_t> parseScaled(std::string_view text, double base) {
    double number = 0;
    const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc() || !(number >= 0)) return std::nullopt;
    std::string_view suffix(rest, static_cast<std::size_t>(text.data() + text.size() - rest));
    double scale = 1;
    if (!suffix.empty()) {
        constexpr std::string_view kSuffixes = "kMGT";
        const char letter = suffix.front() == 'K' ? 'k' : suffix.front();
        const auto power = kSuffixes.find(letter);
        if (power == std::string_view::npos || suffix.size() != 1) return std::nullopt;
        scale = std::pow(base, static_cast<double>(power + 1));
    }
    const double value = std::round(number * scale);
    if (value >= 9.2e18) return std::nullopt;
    return static_cast<std::uint64_t>(value);
}

std::string scaled(double value, double base, const std::array<const char*, 5>& suffixes, int decimals) {
    std::size_t i = 0;
    while (value >= base && i + 1 < suffixes.size()) {
        value /= base;
        ++i;
    }
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f%s", i == 0 ? 0 : decimals, value, suffixes.at(i));
    return text.data();
}

} // namespace

std::optional<Bytes> parseBytes(std::string_view text) {
    if (text.ends_with("iB")) { // the suffix letter alone already means a power of 1024
        text.remove_suffix(2);
        if (text.empty() || std::isalpha(static_cast<unsigned char>(text.back())) == 0) return std::nullopt;
    } else if (text.ends_with('B')) {
        text.remove_suffix(1);
    }
    const auto count = parseScaled(text, 1024.0);
    if (!count) return std::nullopt;
    return Bytes{*count};
}

std::optional<std::uint64_t> parseCount(std::string_view text) {
    return parseScaled(text, 1000.0);
}

std::string readableBytes(Bytes bytes) {
    return scaled(static_cast<double>(bytes.count), 1024.0, {" B", " KiB", " MiB", " GiB", " TiB"}, 2);
}

std::string readableCount(std::uint64_t count) {
    return scaled(static_cast<double>(count), 1000.0, {"", "k", "M", "G", "T"}, 1);
}

} // namespace gnomon
