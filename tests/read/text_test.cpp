// Numbers and words of text: each decimal is the nearest double, and words, lines, comments and continued lines are
// those of a plain reading, wherever the buffer ends.
#include "core/random.h"
#include "preprocess/read/text/number.h"
#include "preprocess/read/text/text_stream.h"
#include "preprocess/read/words.h"
#include "tests/read/scratch_input.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon::read {
namespace {

TEST(Words, LieBetweenBlanksOfAnyKind) {
    using Words = std::vector<std::string_view>;
    EXPECT_EQ(wordsOf(""), Words{});
    EXPECT_EQ(wordsOf(" \t\r"), Words{});
    EXPECT_EQ(wordsOf("one"), Words{"one"});
    EXPECT_EQ(wordsOf("\tf  1/2\v3\f \r"), (Words{"f", "1/2", "3"}));
    EXPECT_EQ(wordsOf("a\nb"), Words{"a\nb"}) << "a line has no line end in it";
}

TEST(Words, AreQuotedInOneShortPrintableLine) {
    EXPECT_EQ(quotedForMessage("abc"), "\"abc\"");
    EXPECT_EQ(quotedForMessage(""), "\"\"");
    EXPECT_EQ(quotedForMessage("a\nb\x1b[31m\xff~ "), "\"a?b?[31m?~ \"");
    EXPECT_EQ(quotedForMessage(std::string(40, 'x')), "\"" + std::string(40, 'x') + "\"");
    EXPECT_EQ(quotedForMessage(std::string(41, 'x')), "\"" + std::string(40, 'x') + "...\"");
}

TEST(Words, HaveASuffixInLowerCase) {
    for (const auto& [path, suffix] : std::vector<std::pair<std::string, std::string>>{
             {"a.obj", ".obj"}, {"b.OFF", ".off"}, {"d.ply/e.stl", ".stl"}, {"", ""}, {"obj", ""}, {"c.stl/d", ""}})
        EXPECT_EQ(loweredSuffix(path), suffix) << path;
}

TEST(Numbers, AreTheNearestDoubles) {
    Random random(44);
    for (int i = 0; i < 20000; ++i) {
        std::string word = random.below(2) == 0 ? "-" : "";
        for (std::uint64_t n = random.below(12); n > 0; --n)
            word += static_cast<char>('0' + random.below(10));
        word += "0.";
        for (std::uint64_t n = random.below(25); n > 0; --n)
            word += static_cast<char>('0' + random.below(10));
        if (random.below(2) == 0) word += "e" + std::to_string(static_cast<int>(random.below(700)) - 350);
        EXPECT_EQ(numberIn(word), std::strtod(word.c_str(), nullptr)) << word;
    }
}

TEST(Numbers, MayBeOfAnySize) {
    for (const char* const word :
         {"1e-46",
          "-2.5e-320",
          "4.9e-324",
          "1e-400",
          "0.1e-5000",
          "1e400",
          "-1e400",
          "1e99999999999999999999",
          "-1e-99999999999999999999",
          "0e999999",
          "1.7976931348623157e308",
          "1.7976931348623159e308",
          "+5",
          ".5",
          "5.",
          "1E5"})
        EXPECT_EQ(numberIn(word), std::strtod(word, nullptr)) << word;
    const std::string zeros(400, '0');
    EXPECT_EQ(numberIn("0." + zeros + "1"), 0.0);
    EXPECT_EQ(numberIn("1" + zeros), std::numeric_limits<double>::infinity());
    EXPECT_EQ(numberIn("0." + zeros + "1e401"), 1.0);
    EXPECT_TRUE(isHugeNumber("1e400", *numberIn("1e400")));
    EXPECT_FALSE(isHugeNumber("inf", *numberIn("inf")));
    EXPECT_FALSE(isHugeNumber("1.#INF", *numberIn("1.#INF")));
    for (const char* const word : {"nan", "-nan", "nan(ind)", "NaN", "1.#QNAN", "-1.#IND", "-1.#IND00", "1.#SNAN"})
        EXPECT_TRUE(std::isnan(numberIn(word).value_or(0))) << word;
    for (const char* const word : {"inf", "-Infinity", "1.#INF", "-1.#INF00"})
        EXPECT_TRUE(std::isinf(numberIn(word).value_or(0))) << word;
    for (const char* const word : {"", "+", "-", "x", "1x", "1,5", "0x1", "1.#", "1.#WHAT", "e5", "1e", "1 "})
        EXPECT_FALSE(numberIn(word)) << word;
}

class Text : public ScratchInput {
protected:
    /// The words of each line of `text` by the stream; an error ends them.
    std::vector<std::vector<std::string>> linesOf(const std::string& text, const TextStream::Rules& rules) {
        std::vector<std::vector<std::string>> lines;
        try {
            TextStream stream(fileOf(text), rules);
            while (stream.nextLine()) {
                lines.emplace_back();
                for (std::string_view word = stream.word(); !word.empty(); word = stream.word())
                    lines.back().emplace_back(word);
            }
        } catch (const Error& error) {
            lines.push_back({error.what()});
        }
        return lines;
    }
};

using Lines = std::vector<std::vector<std::string>>;

TEST_F(Text, HasLinesOfAnyEnd) {
    EXPECT_EQ(linesOf("a b\n\n c\t d ", {}), (Lines{{"a", "b"}, {}, {"c", "d"}}));
    EXPECT_EQ(linesOf("a b\r\nc\r\n", {}), (Lines{{"a", "b"}, {"c"}}));
    EXPECT_EQ(linesOf("a b\rc\r\rd", {}), (Lines{{"a", "b"}, {"c"}, {}, {"d"}}));
    EXPECT_EQ(linesOf("", {}), Lines{});
    EXPECT_EQ(linesOf("\n", {}), Lines{{}});
    EXPECT_EQ(linesOf("\xEF\xBB\xBFv 1", {}), (Lines{{"v", "1"}})) << "behind a mark of UTF-8";
}

TEST_F(Text, HasCommentsWhereTheFormatHas) {
    EXPECT_EQ(linesOf("a #b\n#\nc#d e\n1.#IND #", {.hasComments = true}), (Lines{{"a"}, {}, {"c"}, {"1.#IND"}}));
    EXPECT_EQ(linesOf("a #b\nc#d", {}), (Lines{{"a", "#b"}, {"c#d"}}));
}

TEST_F(Text, HasContinuedLinesWhereTheFormatHas) {
    const TextStream::Rules rules{.hasComments = true, .isContinuable = true};
    EXPECT_EQ(linesOf("a \\\nb\\ \r\n c\nd", rules), (Lines{{"a", "b", "c"}, {"d"}}));
    EXPECT_EQ(linesOf("a\\b c\\ d \\\n\\\n\\\ne", rules), (Lines{{"a\\b", "c\\", "d", "e"}}));
    EXPECT_EQ(linesOf("a # b \\\nc", rules), (Lines{{"a"}, {"c"}}));
    EXPECT_EQ(linesOf("a \\\nb", {}), (Lines{{"a", "\\"}, {"b"}}));
    for (const char* const open : {"x\na \\", "x\na \\\n"})
        EXPECT_TRUE(linesOf(open, rules).back().front().ends_with(":2: the file ends inside a continued line")) << open;
}

TEST_F(Text, MayBeSkippedLineByLine) {
    const TextStream::Rules rules{.hasComments = true, .isContinuable = true};
    TextStream stream(fileOf("skip me \\\n and me\ntake # x \\\nlast\\\n one two # rest \n"), rules);
    std::vector<std::string> words;
    while (stream.nextLine()) {
        words.emplace_back(stream.word());
        words.back() += " " + stream.where().substr(path.size());
    }
    EXPECT_EQ(words, (std::vector<std::string>{"skip :1", "take :3", "last :5"}));
    TextStream again(fileOf("usemtl  Paint #1 \\\n shiny \nb"), rules);
    ASSERT_TRUE(again.nextLine());
    EXPECT_EQ(again.word(), "usemtl");
    EXPECT_EQ(again.rest(), "Paint #1 shiny");
    ASSERT_TRUE(again.nextLine());
    EXPECT_EQ(again.rest(), "b");
    EXPECT_FALSE(again.nextLine());
}

/// The slow, obviously right reading.
Lines plainLinesOf(const std::string& given) {
    std::string text; // with continued lines joined
    for (std::size_t i = 0; i < given.size(); ++i) {
        const bool isContinued = given.compare(i, 2, "\\\n") == 0;
        if (!isContinued) text += given[i];
        i += isContinued ? 1 : 0;
    }
    Lines lines;
    std::size_t begin = 0;
    while (begin < text.size()) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string line = text.substr(begin, end - begin);
        lines.emplace_back();
        for (const std::string_view word : wordsOf(std::string_view(line).substr(0, line.find('#'))))
            lines.back().emplace_back(word);
        begin = end + 1;
    }
    return lines;
}

TEST_F(Text, IsThatOfAPlainReadingWhereverTheBufferEnds) {
    Random random(7);
    std::string text;
    while (text.size() < 2 * ByteStream::kBufferBytes + 100'000) {
        switch (random.below(12)) {
        case 0:
            text += "\n";
            break;
        case 1:
            text += "# " + std::string(random.below(5000), 'c') + "\n";
            break;
        case 2:
            text += std::string(random.below(3000), ' ');
            break;
        case 3:
            text += " \\\n";
            break;
        default:
            text += std::string(1 + random.below(random.below(20) == 0 ? 900 : 9), 'w') + " ";
        }
    }
    text += "end\n";
    EXPECT_TRUE(linesOf(text, {.hasComments = true, .isContinuable = true}) == plainLinesOf(text));
}

/// `text`, all of ASCII, in units of `width` bytes.
std::string widened(const std::string& text, std::size_t width, bool isBigEndian) {
    std::string wide;
    for (const char c : text) {
        std::string unit(width, '\0');
        unit[isBigEndian ? width - 1 : 0] = c;
        wide += unit;
    }
    return wide;
}

TEST_F(Text, InAnotherEncodingIsRefused) {
    const std::string text = "v 0 0 0\r\nv 1 0 0\r\n";
    const auto messageOf = [&](const std::string& bytes) {
        return errorAbout(path, [&] { requireUtf8(fileOf(bytes)); });
    };
    const std::string refused = ": the text is in UTF-16; convert to UTF-8";
    EXPECT_EQ(messageOf("\xFF\xFE" + widened(text, 2, false)), refused);
    EXPECT_EQ(messageOf("\xFE\xFF" + widened(text, 2, true)), refused);
    EXPECT_EQ(messageOf(widened(text, 2, false)), refused);
    EXPECT_EQ(messageOf(widened(text, 2, true)), refused);
    EXPECT_EQ(
        messageOf(std::string("\xFF\xFE\0\0", 4) + widened(text, 4, false)),
        ": the text is in UTF-32; convert to UTF-8");
    EXPECT_EQ(messageOf(widened(text, 4, true)), ": the text is in UTF-32; convert to UTF-8");
    for (const std::string& good :
         {text, std::string(), "\xEF\xBB\xBF" + text, std::string(84, '\0'), std::string("v")})
        EXPECT_EQ(messageOf(good), "no error");
}

} // namespace
} // namespace gnomon::read
