#include "preprocess/read/gltf/uri.h"

#include "core/error.h"
#include "preprocess/read/words.h"

#include <algorithm>
#include <cstdint>
#include <optional>

namespace gnomon::read {

namespace {

constexpr std::string_view kScheme = "data:";

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

/// Returns the byte that a percent sign and two hexadecimal digits at the index `at` of a URI encode. Returns nullopt
/// for other characters.
std::optional<char> percentByte(std::string_view uri, std::size_t at) {
    if (uri[at] != '%' || uri.size() - at < 3) return std::nullopt;
    const int high = hexDigit(uri[at + 1]);
    const int low = hexDigit(uri[at + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    return static_cast<char>(high * 16 + low);
}

int base64Digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+') return 62;
    return c == '/' ? 63 : -1;
}

} // namespace

bool isDataUri(std::string_view uri) {
    return uri.starts_with(kScheme);
}

std::vector<std::byte> bytesOfDataUri(std::string_view uri, const std::string& place) {
    const std::size_t comma = std::min(uri.find(','), uri.size());
    if (comma == uri.size() || !uri.substr(0, comma).ends_with(";base64"))
        throw Error(place, "cannot be understood", "data:TYPE;base64,BYTES", quotedForMessage(uri));
    std::string_view digits = uri.substr(comma + 1);
    for (int i = 0; i < 2 && digits.ends_with('='); ++i)
        digits.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(digits.size() / 4 * 3 + 2);
    std::uint32_t bits = 0;
    int held = 0; // number of decoded bits that do not form a whole byte yet
    for (const char c : digits) {
        const int digit = base64Digit(c);
        if (digit < 0)
            throw Error(
                place,
                "the base64 data is damaged",
                "letters, digits, + and /",
                quotedForMessage(std::string_view(&c, 1)));
        bits = (bits << 6U | static_cast<std::uint32_t>(digit)) & 0xFFFFU;
        held += 6;
        if (held < 8) continue;
        held -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> static_cast<std::uint32_t>(held) & 0xFFU));
    }
    return bytes;
}

std::string fileNameOf(std::string_view uri, const std::string& place) {
    std::string name;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const std::optional<char> byte = percentByte(uri, i);
        if (byte) i += 2;
        name += byte.value_or(uri[i]);
        if (name.back() == '\0')
            throw Error(place, "the uri contains a zero byte (%00)", "the name of a file", quotedForMessage(uri));
    }
    return name;
}

void requirePercentDigits(std::string_view uri, bool hasFile, const std::string& place) {
    if (hasFile) return;
    for (std::size_t i = 0; i < uri.size(); ++i)
        if (uri[i] == '%' && !percentByte(uri, i))
            throw Error(
                place,
                "the uri has a percent sign without two hexadecimal digits",
                "%25 for the sign itself",
                quotedForMessage(uri));
}

} // namespace gnomon::read
