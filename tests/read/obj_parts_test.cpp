// Words of an OBJ, and what its faces make of its vertices, by hand.
#include "core/error.h"
#include "preprocess/read/obj/obj_vertices.h"
#include "preprocess/read/obj/obj_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace gnomon::read {
namespace {

TEST(ObjWords, CornersNameAVertexAndMayNameANormal) {
    const auto indicesOf = [](std::string_view word) {
        const std::optional<ObjIndices> corner = cornerIn(word);
        return corner ? std::pair(corner->vertex, corner->normal) : std::pair(0, 0);
    };
    EXPECT_EQ(indicesOf("3"), std::pair(3, 0));
    EXPECT_EQ(indicesOf("-3/4"), std::pair(-3, 0));
    EXPECT_EQ(indicesOf("3//-5"), std::pair(3, -5));
    EXPECT_EQ(indicesOf("3/4/5"), std::pair(3, 5));
    EXPECT_EQ(indicesOf("3/"), std::pair(3, 0));
    for (const char* const bad : {"", "0", "/1", "1/x", "1/0", "1/2/0", "1/2/3/4", "1 "})
        EXPECT_FALSE(cornerIn(bad)) << bad;
}

ObjLine faceOf(const std::vector<ObjCorner>& corners, std::uint32_t color = 0xFFFFFFFF) {
    ObjLine line;
    line.kind = ObjKind::Face;
    line.corners = corners;
    line.faceColor = color;
    return line;
}

TEST(ObjFace, HasThreeCornersThatDiffer) {
    constexpr std::array<ObjCorner, 5> kCorners{{{1}, {1}, {2}, {1}, {3}}};
    EXPECT_TRUE(isObjFace(kCorners));
    EXPECT_FALSE(isObjFace(std::span(kCorners).first(4)));
    EXPECT_FALSE(isObjFace({}));
}

TEST(ObjVertices, AreSeveralWhereNormalsOrColoursDiffer) {
    const std::vector<ObjCorner> first{{0, 0}, {1, 0}, {2, 0}};
    const std::vector<ObjCorner> second{{0, 1}, {2, 0}, {3}};
    ObjVertices vertices({"a.obj", {1U << 20U}, 5, false, true}, {{0, 0, 1}, {1, 0, 0}}, 2);
    vertices.add(faceOf(first, 7));
    vertices.add(faceOf(second, 7));
    vertices.add(faceOf(first, 9));
    vertices.finish();
    EXPECT_TRUE(vertices.hasNormals());
    EXPECT_FALSE(vertices.isThere(4)) << "no face names it";
    EXPECT_EQ(vertices.ownNormal(0), 0U);
    EXPECT_EQ(vertices.ownNormal(3), ObjVertices::kOwn);
    EXPECT_EQ(vertices.ownColor(2), 7U);
    EXPECT_EQ(vertices.count(), 4U + 4U) << "one with another normal, three with another colour";
    vertices.begin();
    const auto cornersOf = [&](const ObjLine& face) {
        const std::span<const std::uint64_t> corners = vertices.cornersOf(face);
        return std::vector<std::uint64_t>(corners.begin(), corners.end());
    };
    EXPECT_EQ(cornersOf(faceOf(first, 7)), (std::vector<std::uint64_t>{0, 1, 2}));
    EXPECT_EQ(cornersOf(faceOf(second, 7)), (std::vector<std::uint64_t>{5, 2, 3}));
    EXPECT_EQ(cornersOf(faceOf(first, 9)), (std::vector<std::uint64_t>{4, 6, 7}));
    EXPECT_EQ(vertices.normal(vertices.variants()[1].normal), glm::vec3(1, 0, 0));
}

TEST(ObjVertices, AreRefusedBeyondTheirMemory) {
    ObjVertices vertices({"a.obj", {64}, 3, false, false}, {{0, 0, 1}, {1, 0, 0}}, 2);
    const std::vector<ObjCorner> first{{0, 0}, {1, 0}, {2, 0}};
    const std::vector<ObjCorner> second{{0, 1}, {1, 1}, {2, 1}};
    vertices.add(faceOf(first));
    vertices.add(faceOf(second));
    EXPECT_THROW(vertices.finish(), Error);
}

} // namespace
} // namespace gnomon::read
