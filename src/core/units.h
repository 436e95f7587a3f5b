// Sizes, counts and durations as strong types, and functions that convert them from and to readable text.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// A number of bytes.
struct Bytes {
    std::uint64_t count = 0;
    auto operator<=>(const Bytes&) const = default;
};

/// A wall-clock duration.
struct Milliseconds {
    double count = 0;
    auto operator<=>(const Milliseconds&) const = default;
};

constexpr Bytes mebibytes(std::uint64_t n) {
    return {n << 20U};
}

constexpr Bytes gibibytes(std::uint64_t n) {
    return {n << 30U};
}

/// Parses a memory size with a binary suffix: `2G`, `1.5M`, `64k`, `1000`. `2GB` and `2GiB` mean `2G`. Returns nullopt
/// for other text.
std::optional<Bytes> parseBytes(std::string_view text);

/// Parses a count with a decimal suffix: `13M`, `1G`, `2.5k`, `42`. Returns nullopt for other text.
std::optional<std::uint64_t> parseCount(std::string_view text);

/// Returns a number of bytes as readable text such as "1.50 GiB".
std::string readableBytes(Bytes bytes);

/// Returns a readable count such as "13.0M".
std::string readableCount(std::uint64_t count);

} // namespace gnomon
