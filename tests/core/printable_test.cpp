#include "core/formatted.h"
#include "core/printable.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <ios>
#include <string>
#include <vector>

namespace gnomon {
namespace {

TEST(Printable, WhatATerminalWouldObeyIsWrittenOut) {
    EXPECT_EQ(printable("a\nb\tc\rd"), "a\\nb\\tc\\rd");
    EXPECT_EQ(printable("\x1b[31m\a\x7f"), "\\x1b[31m\\x07\\x7f");
    EXPECT_EQ(printable(std::string_view("a\0b", 3)), "a\\x00b");
    EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b") << "the C1 form of ESC [";
    EXPECT_EQ(printable("\xe2\x80\xae"), "\\xe2\\x80\\xae") << "right to left from here";
    EXPECT_EQ(printable("\xe2\x80\xa8"), "\\xe2\\x80\\xa8") << "a line separator";
}

/// UTF-8 of a character, by RFC 3629.
std::string utf8(std::uint32_t code) {
    const auto byte = [](std::uint32_t value) { return static_cast<char>(static_cast<unsigned char>(value)); };
    const auto tail = [&](unsigned shift) { return byte(0x80U | ((code >> shift) & 0x3fU)); };
    if (code < 0x80) return {byte(code)};
    if (code < 0x800) return {byte(0xc0U | code >> 6U), tail(0)};
    if (code < 0x10000) return {byte(0xe0U | code >> 12U), tail(6), tail(0)};
    return {byte(0xf0U | code >> 18U), tail(12), tail(6), tail(0)};
}

TEST(Printable, CharactersThatHideOrTurnTextAreWrittenOut) {
    using Ranges = std::vector<std::array<std::uint32_t, 2>>;
    const Ranges hidden = {{0x0, 0x1f}, {0x7f, 0x9f}, {0xad, 0xad}, {0x61c, 0x61c}, {0x200b, 0x200f}, {0x2028, 0x202e}};
    const Ranges high = {{0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe007f}};
    for (const Ranges& ranges : {hidden, high})
        for (const auto& [first, last] : ranges)
            for (std::uint32_t code = first; code <= last; ++code)
                for (const char c : printable(utf8(code)))
                    EXPECT_TRUE(c >= ' ' && c <= '~') << std::hex << code;
    for (const std::uint32_t code :
         {0x20U,
          0x7eU,
          0xa0U,
          0xacU,
          0xaeU,
          0x61bU,
          0x61dU,
          0x200aU,
          0x2010U,
          0x2027U,
          0x202fU,
          0x205fU,
          0x2070U,
          0xfefeU,
          0xff00U,
          0xfffdU,
          0xdffffU,
          0x1f31eU})
        EXPECT_EQ(printable(utf8(code)), utf8(code)) << std::hex << code;
}

TEST(Printable, WhatIsPrintableStaysAsItIs) {
    for (const char* text : {"", "a b\\n/c.gnm", "\xc3\xbc \xe2\x82\xac \xf0\x9f\x8c\x9e \xc2\xa0", "100% %s"})
        EXPECT_EQ(printable(text), text);
    EXPECT_EQ(printable(printable("\x1b\n\xff")), printable("\x1b\n\xff"));
}

TEST(Printable, BytesThatAreNoUtf8AreWrittenOut) {
    EXPECT_EQ(printable("\xff\xfe.gnm"), "\\xff\\xfe.gnm");
    EXPECT_EQ(printable("a\xe2\x82"), "a\\xe2\\x82") << "cut off";
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b") << "longer than it need be";
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "a half of a pair";
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond the last character";
}

TEST(Formatted, IsWhatPrintfWritesOfAnyLength) {
    EXPECT_EQ(formatted("%d of %s", 3, "four"), "3 of four");
    EXPECT_EQ(formatted("%s", ""), "");
    std::string text(1000, 'x');
    text += '!';
    EXPECT_EQ(formatted("%s!", std::string(1000, 'x').c_str()), text);
}

} // namespace
} // namespace gnomon
