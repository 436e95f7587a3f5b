#include "core/formatted.h"
#include "core/printable.h"

#include <gtest/gtest.h>

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
