// Sizes and counts as people write them, and strong ids.
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

/// A memory size with a binary suffix (`2G`, `1.5M`, `64k`, `1000`; `2GB`, `2GiB` are `2G`); nothing if it is not one.
std::optional<Bytes> parseBytes(std::string_view text);

/// A count with a decimal suffix (`13M`, `1G`, `2.5k`, `42`); nothing if it is not one.
std::optional<std::uint64_t> parseCount(std::string_view text);

/// "1.50 GiB", for people.
std::string readableBytes(Bytes bytes);

/// "13.0M", for people.
std::string readableCount(std::uint64_t count);

} // namespace gnomon
