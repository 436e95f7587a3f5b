#include "core/printable.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace gnomon {

namespace {

/// Returns the length in bytes of a UTF-8 character whose first byte is `first`, or 0 if there is no such character.
std::size_t bytesFrom(unsigned first) {
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4) return 0;
    return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

/// Returns the length in bytes of the first UTF-8 character of `text` (RFC 3629), or 0 if the bytes are invalid.
std::size_t characterBytes(std::string_view text) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t bytes = bytesFrom(at(0));
    if (bytes > text.size()) return 0;
    for (std::size_t i = 1; i < bytes; ++i)
        if ((at(i) & 0xc0U) != 0x80) return 0;
    if (bytes < 3) return bytes;
    // Rejects overlong encodings, UTF-16 surrogates, and codes above U+10FFFF.
    const unsigned start = static_cast<unsigned>(at(0)) << 8U | at(1);
    const bool isTooLong = start < 0xe0a0 || (start >= 0xf000 && start < 0xf090);
    const bool isNoCharacter = (start >= 0xeda0 && start < 0xee00) || start >= 0xf490;
    return isTooLong || isNoCharacter ? 0 : bytes;
}

/// A range of characters that a terminal or a web page interprets or hides. kHidden contains controls, line and
/// paragraph separators, and the characters with the Unicode 15 property Bidi_Control or Default_Ignorable_Code_Point.
struct Range {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

constexpr std::array kHidden = {
    Range{0x0, 0x1f},
    Range{0x7f, 0x9f},
    Range{0xad, 0xad},
    Range{0x34f, 0x34f},
    Range{0x61c, 0x61c},
    Range{0x115f, 0x1160},
    Range{0x17b4, 0x17b5},
    Range{0x180b, 0x180f},
    Range{0x200b, 0x200f},
    Range{0x2028, 0x202e},
    Range{0x2060, 0x206f},
    Range{0x3164, 0x3164},
    Range{0xfe00, 0xfe0f},
    Range{0xfeff, 0xfeff},
    Range{0xffa0, 0xffa0},
    Range{0xfff0, 0xfffb},
    Range{0x1bca0, 0x1bca3},
    Range{0x1d173, 0x1d17a},
    Range{0xe0000, 0xe0fff}};

bool isHidden(std::string_view character) {
    std::uint32_t code = static_cast<unsigned char>(character[0]);
    if (character.size() > 1) code &= 0xffU >> (character.size() + 1);
    for (std::size_t i = 1; i < character.size(); ++i)
        code = (code << 6U) | (static_cast<unsigned char>(character[i]) & 0x3fU);
    const auto* const range =
        std::find_if(kHidden.begin(), kHidden.end(), [code](const Range& candidate) { return code <= candidate.last; });
    return range != kHidden.end() && code >= range->first;
}

} // namespace

std::string printable(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; })) return std::string(text);
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const std::size_t bytes = characterBytes(text);
        const std::string_view character = text.substr(0, bytes == 0 ? 1 : bytes);
        text.remove_prefix(character.size());
        if (bytes != 0 && !isHidden(character)) {
            shown += character;
            continue;
        }
        if (character == "\n" || character == "\t" || character == "\r") {
            shown += character == "\n" ? "\\n" : character == "\t" ? "\\t" : "\\r";
            continue;
        }
        for (const char c : character) {
            const auto byte = static_cast<unsigned char>(c);
            shown += "\\x";
            shown += kDigits[byte >> 4U];
            shown += kDigits[byte & 15U];
        }
    }
    return shown;
}

std::string inWords(const std::exception& error) {
    const auto* const file = dynamic_cast<const std::filesystem::filesystem_error*>(&error);
    if (file == nullptr) return error.what();
    // Messages of std::filesystem errors have the form "filesystem error: OPERATION: REASON [PATH]" in both standard
    // libraries.
    constexpr std::string_view kBefore = "filesystem error: ";
    std::string_view operation = error.what();
    if (operation.substr(0, kBefore.size()) == kBefore) operation.remove_prefix(kBefore.size());
    operation = operation.substr(0, operation.find(':'));
    return file->path1().string() + ": " + std::string(operation) + ": " + file->code().message();
}

} // namespace gnomon
