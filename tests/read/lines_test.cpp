// Words, and what the guards of OBJ, STL and OFF files pass on to a reader that trips easily.
#include "core/error.h"
#include "preprocess/read/line_guards.h"
#include "preprocess/read/words.h"

#include <gtest/gtest.h>

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

/// What a guard passes of some lines, joined by bars; what it leaves out is a dot, an error ends it.
template <class Guard>
std::string passed(const std::vector<std::string>& lines, bool isWhole = false) {
    Guard guard;
    guard.begin();
    std::string result;
    try {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i > 0) result += '|';
            result += guard.pass(lines[i], "f:" + std::to_string(i + 1)).value_or(".");
        }
        if (isWhole) guard.end("f:end");
    } catch (const Error& error) {
        return result + "! " + error.what();
    }
    return result;
}

TEST(ObjGuard, PassesVerticesAndFacesAndNothingElse) {
    EXPECT_EQ(
        passed<ObjGuard>(
            {"v 1 2 3", "vn 0 0 1", "vt 0 0", "f 1 2 3", "# note", "", "usemtl x", "mtllib /etc/passwd", "vc 1 0 0"}),
        "v 1 2 3|vn 0 0 1|.|f 1 2 3|.|.|.|.|vc 1 0 0");
    EXPECT_EQ(passed<ObjGuard>({"v 1 2 3 # note"}), "v 1 2 3 ");
    EXPECT_EQ(passed<ObjGuard>({"v +1 2e3 -.5 1"}), "v +1 2e3 -.5 1") << "a fourth number is the reader's business";
}

TEST(ObjGuard, JoinsContinuedLines) {
    EXPECT_EQ(passed<ObjGuard>({"f 1 2 \\", "3 4"}), ".|f 1 2  3 4");
    EXPECT_EQ(passed<ObjGuard>({"f 1 \\ ", "2 \\", "3"}), ".|.|f 1  2  3");
    EXPECT_EQ(passed<ObjGuard>({"v 1 2 3 \\"}, true), ".! f:end: the file ends inside a continued line");
    ObjGuard guard;
    guard.pass("f 1 2 3", "");
    guard.pass("f 1 2 \\", "");
    EXPECT_EQ(guard.faceLines(), 1U);
    guard.begin();
    EXPECT_EQ(guard.faceLines(), 0U) << "a second pass counts anew";
    EXPECT_EQ(guard.pass("f 3 2 1", ""), "f 3 2 1") << "and knows nothing of the line before";
}

TEST(ObjGuard, CornersHaveAnyOfTheFourFormsAndNoZero) {
    for (const char* corner : {"1", "-1", "1/2", "1/2/3", "1//3", "-1//-3", "1/", "1//"})
        EXPECT_EQ(passed<ObjGuard>({std::string("f 1 2 ") + corner}), std::string("f 1 2 ") + corner);
    for (const char* corner : {"0", "x", "/1", "1/2/3/4", "1/x", "//", "1.5", "99999999999", "1//0"})
        EXPECT_EQ(
            passed<ObjGuard>({std::string("f 1 2 ") + corner}),
            "! f:1: bad corner of a face: expected V, V/T, V//N or V/T/N with V not 0, found \"" + std::string(corner) +
                "\"");
}

TEST(ObjGuard, NumbersMustBeFiniteFloats) {
    EXPECT_EQ(passed<ObjGuard>({"v 1 2"}), "! f:1: too few numbers: expected 3, found 2");
    EXPECT_EQ(passed<ObjGuard>({"v"}), "! f:1: too few numbers: expected 3, found 0");
    for (const char* word : {"nan", "inf", "1e99", "x", "1,5", "0x1"})
        EXPECT_EQ(
            passed<ObjGuard>({std::string("v 1 ") + word + " 3"}),
            "! f:1: bad number: expected a finite one, found \"" + std::string(word) + "\"");
}

TEST(StlGuard, PassesLoopsOfThreeVertices) {
    const std::vector<std::string> facet{
        "solid Part",
        "facet normal 0 0 1",
        "outer loop",
        "VERTEX 0 0 0",
        "vertex 1 0 0",
        "vertex 0 1 0",
        "endloop",
        "endfacet",
        "endsolid"};
    EXPECT_EQ(passed<StlGuard>(facet, true), ".|.|outer loop|vertex 0 0 0|vertex 1 0 0|vertex 0 1 0|.|.|.");
    StlGuard guard;
    for (const std::string& line : facet)
        guard.pass(line, "");
    EXPECT_EQ(guard.facets(), 1U);
}

TEST(StlGuard, EachDisorderIsNamed) {
    EXPECT_EQ(passed<StlGuard>({"vertex 0 0 0"}), "! f:1: a vertex outside of a loop, or the fourth of one");
    EXPECT_EQ(
        passed<StlGuard>({"outer loop", "vertex 0 0 0", "endloop"}),
        "outer loop|vertex 0 0 0|! f:3: bad loop: expected three vertices, found \"endloop\"");
    EXPECT_EQ(
        passed<StlGuard>({"outer loop", "vertex 0 0 0", "vertex 0 0 0", "vertex 0 0 0", "vertex 0 0 0"}),
        "outer loop|vertex 0 0 0|vertex 0 0 0|vertex 0 0 0|! f:5: a vertex outside of a loop, or the fourth of one");
    EXPECT_EQ(passed<StlGuard>({"faces 3"}), "! f:1: not a line of an STL file: \"faces\"");
    EXPECT_EQ(passed<StlGuard>({"solid"}, true), ".! f:end: the file ends too early: no endsolid");
    EXPECT_EQ(passed<StlGuard>({"outer loop"}, true), "outer loop! f:end: the file ends too early: no endsolid");
    EXPECT_EQ(passed<StlGuard>({"outer loop", "vertex 0 0"}), "outer loop|! f:2: too few numbers: expected 3, found 2");
}

TEST(OffGuard, GivesEachThingItsLine) {
    EXPECT_EQ(
        passed<OffGuard>({"OFF", "# note", "3 1 0", "0 0 0", "1 0 0", "0 1 0 # corner", "3 0 1 2 255 0 0"}, true),
        "OFF|.|3 1 0|0 0 0|1 0 0|0 1 0|3 0 1 2");
    EXPECT_EQ(passed<OffGuard>({"OFF 0 0 0"}, true), "OFF\n0 0 0");
    EXPECT_EQ(passed<OffGuard>({"COFF", "1 0 0", "0 0 0 255 0 0"}), "COFF|1 0 0|0 0 0 255 0 0");
    EXPECT_EQ(passed<OffGuard>({"NOFF", "1 0 0", "0 0 0 0 0 1"}), "NOFF|1 0 0|0 0 0 0 0 1");
}

TEST(OffGuard, EachDisorderIsNamed) {
    const auto counts = [](const std::string& line) { return passed<OffGuard>({"OFF", line}); };
    for (const char* bad : {"3", "3 1", "3 1 0 0", "3 -1 0", "3 1 x", "4294967296 1 0"})
        EXPECT_NE(
            counts(bad).find("f:2: bad counts: expected the numbers of vertices, faces and edges"), std::string::npos)
            << bad;
    EXPECT_EQ(passed<OffGuard>({"OFF", "1 1 0", "0 0"}), "OFF|1 1 0|! f:3: too few numbers: expected 3, found 2");
    EXPECT_EQ(
        passed<OffGuard>({"NOFF", "1 1 0", "0 0 0 0 0"}), "NOFF|1 1 0|! f:3: too few numbers: expected 6, found 5");
    EXPECT_EQ(
        passed<OffGuard>({"COFF", "1 1 0", "0 0 0 1 1"}),
        "COFF|1 1 0|! f:3: bad vertex: expected a colour of three or four channels, found 2 values");
    EXPECT_EQ(
        passed<OffGuard>({"OFF", "0 1 0", "3 0 1"}),
        "OFF|0 1 0|! f:3: bad face: expected a number of corners and as many indices, found 3 words");
    EXPECT_EQ(
        passed<OffGuard>({"OFF", "0 1 0", "3 0 1 x"}), "OFF|0 1 0|! f:3: bad face: expected an index, found \"x\"");
    EXPECT_EQ(
        passed<OffGuard>({"OFF", "0 0 0", "0 0 0"}),
        "OFF|0 0 0|! f:3: data after the last face: the counts are too small");
    EXPECT_EQ(
        passed<OffGuard>({"OFF", "2 1 0", "0 0 0"}, true),
        "OFF|2 1 0|0 0 0! f:end: the file ends too early: expected 1 more vertices and 1 more faces, found the end");
    EXPECT_NE(passed<OffGuard>({"OFF"}, true).find("the file ends too early"), std::string::npos);
}

} // namespace
} // namespace gnomon::read
