#include "core/printable.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace gnomon {

namespace {

/// How many bytes the UTF-8 character has that begins with `first`; 0 if none does.
std::size_t bytesFrom(unsigned first) {
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4) return 0;
    return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

/// The bytes of the UTF-8 character that `text` begins with, by RFC 3629; 0 if it begins with none.
std::size_t characterBytes(std::string_view text) {
    const auto at = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const std::size_t bytes = bytesFrom(at(0));
    if (bytes > text.size()) return 0;
    for (std::size_t i = 1; i < bytes; ++i)
        if ((at(i) & 0xc0U) != 0x80) return 0;
    if (bytes < 3) return bytes;
    // What is written longer than it need be, half a pair of UTF-16, what is beyond the last character.
    const unsigned start = static_cast<unsigned>(at(0)) << 8U | at(1);
    const bool isTooLong = start < 0xe0a0 || (start >= 0xf000 && start < 0xf090);
    const bool isNoCharacter = (start >= 0xeda0 && start < 0xee00) || start >= 0xf490;
    return isTooLong || isNoCharacter ? 0 : bytes;
}

/// Whether a terminal obeys the character instead of showing it.
bool isControl(std::string_view character) {
    std::uint32_t code = static_cast<unsigned char>(character[0]);
    if (character.size() > 1) code &= 0xffU >> (character.size() + 1);
    for (std::size_t i = 1; i < character.size(); ++i)
        code = (code << 6U) | (static_cast<unsigned char>(character[i]) & 0x3fU);
    const auto isIn = [code](std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; };
    return code < 0x20 || isIn(0x7f, 0x9f) || isIn(0x200e, 0x200f) || isIn(0x2028, 0x202e) || isIn(0x2066, 0x2069);
}

} // namespace

std::string printable(std::string_view text) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string shown;
    shown.reserve(text.size());
    while (!text.empty()) {
        const std::size_t bytes = characterBytes(text);
        const std::string_view character = text.substr(0, bytes == 0 ? 1 : bytes);
        text.remove_prefix(character.size());
        if (bytes != 0 && !isControl(character)) {
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
    // "filesystem error: OPERATION: REASON [PATH]", as both standard libraries have it.
    constexpr std::string_view kBefore = "filesystem error: ";
    std::string_view operation = error.what();
    if (operation.substr(0, kBefore.size()) == kBefore) operation.remove_prefix(kBefore.size());
    operation = operation.substr(0, operation.find(':'));
    return file->path1().string() + ": " + std::string(operation) + ": " + file->code().message();
}

} // namespace gnomon
