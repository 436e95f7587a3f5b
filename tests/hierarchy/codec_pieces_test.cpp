// The codec's pieces one by one: planes of bytes, the window of open edges, codes of triangles, numbers of vertices.
#include "core/random.h"
#include "damage_text.h"
#include "hierarchy/codec/connectivity_decoder.h"
#include "hierarchy/codec/connectivity_encoder.h"
#include "hierarchy/codec/edge_window.h"
#include "hierarchy/codec/plane_kernel.h"
#include "hierarchy/codec/vertex_numbers.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>

namespace gnomon::hierarchy {
namespace {

/// Numbers of at most `planes` bytes, as planes and as they are.
struct SomePlanes {
    SomePlanes(Random& random, unsigned planeCount, std::size_t count) : bytes(planeCount * count), numbers(count) {
        for (std::size_t i = 0; i < count; ++i)
            for (unsigned plane = 0; plane < planeCount; ++plane) {
                bytes[plane * count + i] = static_cast<std::uint8_t>(random.bits());
                numbers[i] |= std::uint32_t{bytes[plane * count + i]} << (8 * plane);
            }
        planes = {bytes.data(), planeCount, count};
    }

    std::vector<std::uint8_t> bytes;
    std::vector<std::uint32_t> numbers;
    Planes planes;
};

constexpr std::array<std::size_t, 10> kCounts = {0, 1, 3, 4, 7, 8, 15, 16, 17, 100};

TEST(PlaneKernel, JoinsPlanesOnEveryInstructionSet) {
    tests::onEachTarget([](const char* name) {
        Random random(1);
        for (const std::size_t count : kCounts)
            for (unsigned planeCount = 0; planeCount <= 4; ++planeCount) {
                const SomePlanes some(random, planeCount, count);
                std::vector<std::uint32_t> out(count + kMaxLanes);
                decodeNumbers(some.planes, out.data());
                EXPECT_TRUE(std::equal(some.numbers.begin(), some.numbers.end(), out.begin())) << name << ' ' << count;
            }
    });
}

TEST(PlaneKernel, TurnsCodesIntoDifferencesOnEveryInstructionSet) {
    tests::onEachTarget([](const char* name) {
        Random random(2);
        for (const std::size_t count : kCounts) {
            std::vector<SomePlanes> some;
            for (unsigned k = 0; k < 4; ++k)
                some.emplace_back(random, static_cast<unsigned>(1 + random.below(4)), count);
            const std::array<Planes, 4> planes{some[0].planes, some[1].planes, some[2].planes, some[3].planes};
            std::vector<PositionWords> positions(count + kMaxLanes);
            std::vector<std::uint64_t> normals(count + kMaxLanes);
            std::vector<std::uint32_t> colors(count + kMaxLanes);
            decodePositions(std::span(planes).first<3>(), positions.data());
            decodeNormals(std::span(planes).first<2>(), 0x3FFU, normals.data());
            decodeColors(planes, colors.data());
            for (std::size_t i = 0; i < count; ++i) {
                std::array<std::uint32_t, 4> difference{};
                for (std::size_t k = 0; k < 4; ++k)
                    difference[k] = unzigzag(some[k].numbers[i]);
                for (std::size_t k = 0; k < 3; ++k)
                    EXPECT_EQ(positions[i].word[k], difference[k]) << name;
                EXPECT_EQ(positions[i].word[3], 0U) << name;
                EXPECT_EQ(normals[i], joinedNormal(difference[0] & 0x3FFU, difference[1] & 0x3FFU)) << name;
                std::uint32_t color = 0;
                for (unsigned k = 0; k < 4; ++k)
                    color |= (difference[k] & 0xFFU) << (8 * k);
                EXPECT_EQ(colors[i], color) << name;
            }
        }
    });
}

TEST(VertexCode, ZigzagIsOneToOneAndSmallForSmallDifferences) {
    EXPECT_EQ(zigzag(0), 0U);
    EXPECT_EQ(zigzag(0U - 1), 1U);
    EXPECT_EQ(zigzag(1), 2U);
    EXPECT_EQ(zigzag(0x80000000U), 0xFFFFFFFFU);
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const auto value = static_cast<std::uint32_t>(random.bits() >> random.below(64));
        EXPECT_EQ(unzigzag(zigzag(value)), value);
        EXPECT_EQ(zigzag(unzigzag(value)), value);
    }
}

TEST(VertexCode, ANormalComesBackFromItsTwoNumbers) {
    Random random(4);
    for (unsigned shift = 0; shift <= 15; ++shift) {
        const NormalCode code{shift};
        EXPECT_EQ(code.width(), 16 - shift);
        EXPECT_EQ(code.mask(), (1U << (16 - shift)) - 1);
        for (int i = 0; i < 100; ++i) {
            const std::uint32_t low = (1U << shift) - 1;
            const auto normal = static_cast<std::uint32_t>(random.bits()) & ~(low | low << 16U);
            EXPECT_LE(code.x(normal), code.mask());
            EXPECT_LE(code.y(normal), code.mask());
            EXPECT_EQ(code.normal(code.x(normal), code.y(normal)), normal);
            EXPECT_EQ(code.normal(code.x(normal) + code.mask() + 1, code.y(normal)), normal) << "modulo its width";
        }
    }
    const NormalCode code{6};
    EXPECT_LT(code.x(0x8000U), code.x(0)) << "offset binary ascends from the most negative";
    EXPECT_LT(code.x(0), code.x(0x7FC0U));
}

TEST(EdgeWindow, HoldsTheLastSixteenNewestFirst) {
    Random random(5);
    EdgeWindow window;
    std::deque<std::array<std::uint32_t, 3>> plain;
    for (int i = 0; i < 200; ++i) {
        std::array<std::uint32_t, 3> t{};
        for (std::uint32_t& corner : t)
            corner = static_cast<std::uint32_t>(random.below(256));
        const bool entered = random.below(2) == 0;
        window.pushTriangle(t[0], t[1], t[2], entered);
        if (!entered) plain.push_front({t[1], t[0], t[2]});
        plain.push_front({t[0], t[2], t[1]});
        plain.push_front({t[2], t[1], t[0]});
        ASSERT_EQ(window.count(), std::min<std::size_t>(plain.size(), 16));
        for (unsigned age = 0; age < window.count(); ++age) {
            const OpenEdge edge = window.recent(age);
            EXPECT_EQ((std::array{edge.from, edge.to, edge.opposite}), plain[age]) << i << ' ' << age;
        }
    }
}

/// A page of one cluster with these triangles, which it need not have yet.
Page onePage(std::uint32_t vertices, std::uint32_t triangles) {
    Page page;
    page.clusters = {{0, 0, vertices, triangles, kNone, {}}};
    return page;
}

std::string damageOfCodes(std::vector<std::uint8_t> codes, std::vector<std::uint8_t> indices, std::uint32_t vertices) {
    Page page = onePage(vertices, static_cast<std::uint32_t>(codes.size()));
    EdgeWords edges;
    const std::size_t count = indices.size();
    indices.push_back(0); // one byte may be looked at behind the last
    return damageOf([&] {
        decodeConnectivity(
            std::as_bytes(std::span(codes)), std::as_bytes(std::span(indices)).first(count), page, edges);
    });
}

TEST(Connectivity, AFanAndAStripAreCodedAsTheFormatSays) {
    ByteWriter codes;
    ByteWriter indices;
    ConnectivityEncoder encoder(codes, indices);
    const std::vector<Triangle> triangles{{0, 1, 2}, {2, 1, 3}, {2, 3, 0}, {9, 8, 7}};
    encoder.encode(triangles);
    const std::vector<std::byte> expected{
        std::byte{0xF7},  // three new corners
        std::byte{0x00},  // across the newest edge, 2 to 1, to the next new vertex
        std::byte{0x14},  // across the one before it, 2 to 3, to vertex 0: four before the next new one
        std::byte{0xF0}}; // three that follow
    EXPECT_EQ(codes.bytes(), expected);
    EXPECT_EQ(indices.bytes(), (std::vector<std::byte>{std::byte{9}, std::byte{8}, std::byte{7}}));
    EXPECT_EQ(encoder.parents()[3].from, 2);
    EXPECT_EQ(encoder.parents()[3].to, 1);
    EXPECT_EQ(encoder.parents()[3].opposite, 0);
    EXPECT_EQ(encoder.parents()[3].acrossEdge, 1);
    EXPECT_EQ(encoder.parents()[1].acrossEdge, 0);
}

TEST(Connectivity, RandomTrianglesComeBackWithTheEdgesTheyWereEnteredAcross) {
    Random random(6);
    for (int trial = 0; trial < 300; ++trial) {
        const std::uint64_t vertices = 1 + random.below(256);
        std::vector<Triangle> triangles(1 + random.below(256));
        for (Triangle& t : triangles)
            for (std::uint8_t& corner : t)
                corner = static_cast<std::uint8_t>(random.below(vertices));
        for (std::size_t i = 1; i < triangles.size(); ++i)
            if (random.below(2) == 0) { // across the edge from corner 2 to corner 1 of the one before
                triangles[i][0] = triangles[i - 1][2];
                triangles[i][1] = triangles[i - 1][1];
            }
        ByteWriter codes;
        ByteWriter indices;
        ConnectivityEncoder encoder(codes, indices);
        encoder.encode(triangles);
        const std::size_t indexBytes = indices.size();
        indices.put(std::uint8_t{0});
        Page page = onePage(256, static_cast<std::uint32_t>(triangles.size()));
        EdgeWords edges;
        decodeConnectivity(codes.bytes(), std::span(indices.bytes()).first(indexBytes), page, edges);
        ASSERT_EQ(page.triangles, triangles);
        for (std::size_t v = 0; v < vertices; ++v) {
            const Parents& parents = encoder.parents()[v];
            if (parents.acrossEdge == 0) continue;
            EXPECT_EQ(
                edges[v], parents.from | std::uint32_t{parents.to} << 8U | std::uint32_t{parents.opposite} << 16U);
        }
    }
}

TEST(Connectivity, EachLieIsNamed) {
    const std::string noCorner = "a triangle refers to a missing vertex";
    const std::string noEdge = "a triangle refers to a missing vertex or edge";
    EXPECT_EQ(damageOfCodes({0xF7}, {}, 3), "");
    EXPECT_EQ(damageOfCodes({0xF7}, {}, 2), noCorner) << "a third new vertex of two";
    EXPECT_EQ(damageOfCodes({0xF7, 0x00}, {}, 3), noCorner) << "a fourth of three";
    EXPECT_EQ(damageOfCodes({0xF7, 0x00}, {}, 4), "");
    EXPECT_EQ(damageOfCodes({0xF0}, {0, 1}, 3), noCorner) << "a third index of two";
    EXPECT_EQ(damageOfCodes({0xF0}, {0, 1, 3}, 3), noCorner);
    EXPECT_EQ(damageOfCodes({0xF0}, {0, 1, 2}, 3), "");
    EXPECT_EQ(damageOfCodes({0xF7}, {0}, 3), "the page has unused indices");
    EXPECT_EQ(damageOfCodes({0x00}, {}, 3), noEdge) << "entered across an edge before there is any";
    EXPECT_EQ(damageOfCodes({0xF7, 0x30}, {}, 4), noEdge) << "across the fourth of three";
    EXPECT_EQ(damageOfCodes({0xF7, 0x20}, {}, 4), "");
    EXPECT_EQ(damageOfCodes({0xF7, 0x04}, {}, 4), noEdge) << "the vertex four before the third";
    EXPECT_EQ(damageOfCodes({0xF7, 0x03}, {}, 4), "");
    EXPECT_EQ(damageOfCodes({0xF7, 0x0F}, {3}, 3), noCorner);
    EXPECT_EQ(damageOfCodes({0xF7, 0x0F}, {2}, 3), "");
}

TEST(VertexNumbers, AreSplitIntoReferencesAndFreshOnes) {
    ByteWriter out;
    out.put(std::uint8_t{1}); // one plane of references
    for (const unsigned code : {0U, 1U, 0U, 4U, 0U})
        out.put(static_cast<std::uint8_t>(code));
    for (int k = 0; k < 3; ++k) { // positions of the three fresh ones
        out.put(std::uint8_t{1});
        for (const int code : {0, 1, 2})
            out.put(static_cast<std::uint8_t>(code + k));
    }
    VertexNumbers numbers;
    ByteReader in(out.bytes());
    takeVertexNumbers(in, 5, {}, numbers);
    in.expectEnd();
    EXPECT_EQ(numbers.referring, (std::vector<std::uint32_t>{1, 3}));
    EXPECT_EQ(numbers.fresh, (std::vector<std::uint32_t>{0, 2, 4}));
    EXPECT_EQ(numbers.references[3], 4U);
    EXPECT_EQ(numbers.positions[1].word[0], 0U - 1) << "zigzag of 1";
    EXPECT_EQ(numbers.positions[1].word[1], 1U);
    ByteWriter wide;
    wide.put(std::uint8_t{5});
    EXPECT_EQ(
        damageOf([&] {
            ByteReader five(wide.bytes());
            takeVertexNumbers(five, 0, {}, numbers);
        }),
        "a value has more than four bytes");
    ByteWriter few;
    few.put(std::uint8_t{4});
    EXPECT_EQ(
        damageOf([&] {
            ByteReader none(few.bytes());
            takeVertexNumbers(none, std::size_t{1} << 40U, {}, numbers);
        }),
        "the bytes end too early");
}

} // namespace
} // namespace gnomon::hierarchy
