// The colours of coarse vertices: sharp where a pattern stays, its mean where it goes, and what is charged for that.
#include "core/random.h"
#include "preprocess/levels/channel_fit.h"
#include "preprocess/levels/color_transfer.h"
#include "preprocess/proximity/triangle_distance.h"
#include "preprocess/simplify/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace gnomon::levels {
namespace {

using simplify::colorCharge;

constexpr std::uint32_t kSide = 24;   // squares of the sheet, along each side
constexpr std::uint32_t kEdge = 1000; // grid steps, the side of a square
constexpr std::uint32_t kWhite = 0xFFFFFFFFU;
constexpr std::uint32_t kBlack = 0xFF000000U;

std::uint32_t grey(double value) {
    const auto byte = static_cast<std::uint32_t>(std::lround(value * 255));
    return 0xFF000000U | byte << 16U | byte << 8U | byte;
}

double redOf(std::uint32_t color) {
    return static_cast<double>(color & 0xFFU) / 255;
}

/// A flat sheet with the colour that `colorAt(column, row)` gives each vertex; its first two columns are locked.
template <class ColorAt>
simplify::Patch sheet(const ColorAt& colorAt) {
    simplify::Patch patch;
    for (std::uint32_t row = 0; row <= kSide; ++row)
        for (std::uint32_t column = 0; column <= kSide; ++column) {
            hierarchy::Vertex vertex;
            vertex.position = {column * kEdge, 5, row * kEdge};
            vertex.color = colorAt(column, row);
            patch.positionOf.push_back(static_cast<std::uint32_t>(patch.positions.size()));
            patch.positions.emplace_back(vertex.position.x, vertex.position.y, vertex.position.z);
            patch.isLocked.push_back(column < 2 ? 1 : 0);
            patch.vertices.push_back(vertex);
        }
    for (std::uint32_t row = 0; row < kSide; ++row)
        for (std::uint32_t column = 0; column < kSide; ++column) {
            const std::uint32_t a = row * (kSide + 1) + column;
            const std::uint32_t c = a + kSide + 2;
            patch.triangles.push_back({a, c, a + 1});
            patch.triangles.push_back({a, a + kSide + 1, c});
        }
    return patch;
}

simplify::SimplifiedPatch halved(const simplify::Patch& patch) {
    return simplify::simplifyQuadric(patch, patch.triangles.size() / 2);
}

std::vector<std::uint32_t> colorsAfter(const simplify::Patch& patch, const ColorTransfer& transfer) {
    std::vector<std::uint32_t> colors;
    for (const hierarchy::Vertex& vertex : patch.vertices)
        colors.push_back(vertex.color);
    for (const TransferredWord& color : transfer.colors)
        colors[color.vertex] = color.word;
    return colors;
}

/// The mean of red over the area of `triangles`.
double meanRed(
    const simplify::Patch& patch,
    const std::vector<simplify::Triangle>& triangles,
    const std::vector<std::uint32_t>& colors) {
    double sum = 0;
    double area = 0;
    for (const simplify::Triangle& t : triangles) {
        const simplify::Triangle p = patch.corners(t);
        const glm::dvec3& a = patch.positions[p[0]];
        const double own = glm::length(glm::cross(patch.positions[p[1]] - a, patch.positions[p[2]] - a));
        area += own;
        for (const std::uint32_t v : t)
            sum += own * redOf(colors[v]) / 3;
    }
    return sum / area;
}

/// Red at `p` of the triangle nearest to it, the slow way: every triangle is looked at.
double redAt(
    const glm::dvec3& p,
    const simplify::Patch& patch,
    const std::vector<simplify::Triangle>& triangles,
    const std::vector<std::uint32_t>& colors) {
    double best = std::numeric_limits<double>::infinity();
    double red = 0;
    for (const simplify::Triangle& t : triangles) {
        const simplify::Triangle q = patch.corners(t);
        const glm::dvec3& a = patch.positions[q[0]];
        const glm::dvec3& b = patch.positions[q[1]];
        const glm::dvec3& c = patch.positions[q[2]];
        const double square = proximity::squaredDistance(p, a, b, c);
        if (square >= best) continue;
        best = square;
        const double whole = glm::length(glm::cross(b - a, c - a));
        red = (glm::length(glm::cross(b - p, c - p)) * redOf(colors[t[0]]) +
               glm::length(glm::cross(c - p, a - p)) * redOf(colors[t[1]]) +
               glm::length(glm::cross(a - p, b - p)) * redOf(colors[t[2]])) /
              whole;
    }
    return red;
}

TEST(ColorCharge, IsNothingBelowWhatIsSeenAndGrowsWithLengthAndDifference) {
    EXPECT_EQ(colorCharge(100, 0), 0);
    EXPECT_EQ(colorCharge(100, 0.02), 0);
    EXPECT_GT(colorCharge(100, 0.05), 0);
    EXPECT_LT(colorCharge(100, 0.05), colorCharge(100, 0.5));
    EXPECT_DOUBLE_EQ(colorCharge(200, 0.5), 2 * colorCharge(100, 0.5));
    EXPECT_GE(colorCharge(100, 1), 100) << "black for white is an error as long as what moved, or more";
}

TEST(ColorTransfer, OneColourCostsNothing) {
    const simplify::Patch patch = sheet([](auto, auto) { return 0xFF123456U; });
    const ColorTransfer transfer = transferredColors(patch, halved(patch));
    EXPECT_EQ(transfer.error, 0);
    EXPECT_TRUE(transfer.colors.empty());
}

TEST(ColorTransfer, AGradientIsKeptByWhatIsInterpolated) {
    const simplify::Patch patch =
        sheet([](std::uint32_t column, std::uint32_t row) { return grey((column + 2.0 * row) / (3.0 * kSide)); });
    const simplify::SimplifiedPatch simplified = halved(patch);
    const ColorTransfer transfer = transferredColors(patch, simplified);
    EXPECT_EQ(transfer.error, 0);
    const std::vector<std::uint32_t> colors = colorsAfter(patch, transfer);
    for (const simplify::Triangle& t : simplified.triangles)
        for (const std::uint32_t v : t)
            EXPECT_NEAR(redOf(colors[v]), redOf(patch.vertices[v].color), 0.02);
}

TEST(ColorTransfer, ANoiseLeavesItsMeanAndIsCharged) {
    double off = 0;
    double offWithout = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        Random random(seed);
        const simplify::Patch patch = sheet([&](auto, auto) { return random.below(4) == 0 ? kBlack : kWhite; });
        const simplify::SimplifiedPatch simplified = halved(patch);
        const ColorTransfer transfer = transferredColors(patch, simplified);
        std::vector<std::uint32_t> before;
        for (const hierarchy::Vertex& vertex : patch.vertices)
            before.push_back(vertex.color);
        const double truth = meanRed(patch, patch.triangles, before);
        const double after = meanRed(patch, simplified.triangles, colorsAfter(patch, transfer));
        off += std::abs(after - truth);
        offWithout += std::abs(meanRed(patch, simplified.triangles, before) - truth);
        EXPECT_GT(transfer.error, kEdge) << seed;
    }
    EXPECT_LT(off, 0.75 * offWithout) << "but for what locked vertices and the ends of the scale keep";
}

TEST(ColorTransfer, LockedVerticesKeepTheirColours) {
    Random random(7);
    const simplify::Patch patch = sheet([&](auto, auto) { return static_cast<std::uint32_t>(random.bits()); });
    const ColorTransfer transfer = transferredColors(patch, halved(patch));
    EXPECT_GT(transfer.colors.size(), 50U);
    std::uint32_t last = 0;
    for (const TransferredWord& color : transfer.colors) {
        EXPECT_EQ(patch.isLocked[patch.positionOf[color.vertex]], 0);
        EXPECT_NE(color.word, patch.vertices[color.vertex].color);
        EXPECT_TRUE(last == 0 || color.vertex > last) << "ascending";
        last = color.vertex;
    }
}

TEST(FieldTransfer, IsThatOfColoursButForTheCharge) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        Random random(seed);
        simplify::Patch patch = sheet([&](auto, auto) { return static_cast<std::uint32_t>(random.bits()); });
        const simplify::SimplifiedPatch simplified = halved(patch);
        EXPECT_TRUE(transferredFields(patch, simplified).empty()) << "no fields yet";
        patch.fields.layout = {{8, 8, 8, 8}};
        for (const hierarchy::Vertex& vertex : patch.vertices)
            patch.fields.words.push_back(vertex.color);
        const std::vector<TransferredWord> colors = transferredColors(patch, simplified).colors;
        const std::vector<TransferredWord> fields = transferredFields(patch, simplified);
        EXPECT_TRUE(std::ranges::equal(
            colors, fields, [](const auto& a, const auto& b) { return a.vertex == b.vertex && a.word == b.word; }));
        EXPECT_GT(fields.size(), 50U);
    }
}

TEST(FieldTransfer, KeepsAGradientOfSixteenBits) {
    simplify::Patch patch = sheet([](auto, auto) { return kWhite; });
    patch.fields.layout = hierarchy::FieldLayout::of(2);
    for (std::uint32_t v = 0; v < patch.vertices.size(); ++v) {
        const std::uint32_t column = v % (kSide + 1);
        const std::uint32_t row = v / (kSide + 1);
        patch.fields.words.push_back(column * 2000 | (row * 2500) << 16U);
    }
    const simplify::SimplifiedPatch simplified = halved(patch);
    for (const TransferredWord& moved : transferredFields(patch, simplified)) {
        const std::uint32_t before = patch.fields.words[moved.vertex];
        for (std::size_t field = 0; field < 2; ++field) {
            const double change = static_cast<double>(patch.fields.layout.number(moved.word, field)) -
                                  patch.fields.layout.number(before, field);
            EXPECT_LE(std::abs(change), 1300) << "half a square: at the sheet's edge what vanished lay on one side";
        }
    }
}

TEST(ColorTransfer, ASeamStaysSharp) {
    // Right of the middle all corners have vertices of their own, so that both colours meet without mixing.
    simplify::Patch patch = sheet([](auto, auto) { return 0xFF0000FFU; });
    const auto vertices = static_cast<std::uint32_t>(patch.vertices.size());
    for (std::uint32_t v = 0; v < vertices; ++v) {
        patch.vertices.push_back(patch.vertices[v]);
        patch.vertices.back().color = 0xFFFF0000U;
        patch.positionOf.push_back(v);
    }
    for (simplify::Triangle& t : patch.triangles) {
        const auto isRight = [](std::uint32_t v) { return v % (kSide + 1) >= kSide / 2; };
        if (isRight(t[0]) && isRight(t[1]) && isRight(t[2]))
            for (std::uint32_t& v : t)
                v += vertices;
    }
    const ColorTransfer transfer = transferredColors(patch, halved(patch));
    for (const std::uint32_t color : colorsAfter(patch, transfer))
        EXPECT_TRUE(color == 0xFF0000FFU || color == 0xFFFF0000U) << color;
    EXPECT_EQ(transfer.error, 0);
}

/// The sheet in squares of one colour each, of `random` out of three; where they meet each has vertices of its own.
simplify::Patch patchwork(Random& random) {
    constexpr std::uint32_t kSquare = 3;
    simplify::Patch patch = sheet([](auto, auto) { return kWhite; });
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> vertexOf; // by position and square
    std::map<std::uint32_t, std::uint32_t> colorOf;
    const simplify::Patch plain = patch;
    patch.vertices.clear();
    patch.positionOf.clear();
    for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
        const auto square = static_cast<std::uint32_t>(t / 2);
        const std::uint32_t part = square % kSide / kSquare + square / kSide / kSquare * kSide;
        const std::uint32_t color = colorOf.try_emplace(part, 0xFF000000U | 0xFFU << 8 * random.below(3)).first->second;
        for (std::uint32_t& v : patch.triangles[t]) {
            const auto next = static_cast<std::uint32_t>(patch.vertices.size());
            const auto [found, isNew] = vertexOf.try_emplace({v, part}, next);
            if (isNew) {
                patch.vertices.push_back(plain.vertices[v]);
                patch.vertices.back().color = color;
                patch.positionOf.push_back(v);
            }
            v = found->second;
        }
    }
    return patch;
}

/// Whether all simplified triangles with a corner where one of `t` went are of the colour of `t`, the slow way.
bool isOfOneColor(
    const simplify::Triangle& t, const simplify::Patch& patch, const simplify::SimplifiedPatch& simplified) {
    const auto placesAt = [&](std::uint32_t v) { return simplified.movedTo[patch.positionOf[v]]; };
    const auto isOfColor = [&](std::uint32_t v) { return patch.vertices[v].color == patch.vertices[t[0]].color; };
    return std::ranges::all_of(t, isOfColor) &&
           std::ranges::all_of(simplified.triangles, [&](const simplify::Triangle& other) {
               const bool isAround = std::ranges::any_of(t, [&](std::uint32_t v) {
                   return std::ranges::any_of(
                       other, [&](std::uint32_t w) { return placesAt(v) == patch.positionOf[w]; });
               });
               return !isAround || std::ranges::all_of(other, isOfColor);
           });
}

TEST(ColorTransfer, LooksAtTrianglesWithMoreThanOneColourAroundThem) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        Random random(seed);
        const simplify::Patch patch = patchwork(random);
        const simplify::SimplifiedPatch simplified = halved(patch);
        std::vector<std::uint32_t> words;
        for (const hierarchy::Vertex& vertex : patch.vertices)
            words.push_back(vertex.color);
        ChannelFit fit(patch, simplified, words, {{8, 8, 8, 8}});
        fit.run();
        int points = 0;
        fit.forEachDifference([&](double, double) { ++points; });
        const auto plain = std::ranges::count_if(
            patch.triangles, [&](const simplify::Triangle& t) { return isOfOneColor(t, patch, simplified); });
        EXPECT_GT(plain, 100);
        EXPECT_GT(points, 1000);
        EXPECT_EQ(points, 3 * (static_cast<int>(patch.triangles.size()) - plain)) << seed;
    }
}

TEST(ColorTransfer, TheErrorIsThatOfThePointWhereMostIsOff) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        Random random(seed);
        const simplify::Patch patch = sheet([&](std::uint32_t column, std::uint32_t row) {
            return random.below(60) == 0 ? kBlack : grey(0.5 + 0.5 * std::sin(0.3 * column) * std::sin(0.4 * row));
        });
        const simplify::SimplifiedPatch simplified = halved(patch);
        const ColorTransfer transfer = transferredColors(patch, simplified);
        std::vector<std::uint32_t> before;
        for (const hierarchy::Vertex& vertex : patch.vertices)
            before.push_back(vertex.color);
        const std::vector<std::uint32_t> after = colorsAfter(patch, transfer);
        double maxOff = 0;
        double longest = 0;
        for (std::uint32_t p = 0; p < patch.positions.size(); ++p)
            longest = std::max(longest, glm::length(patch.positions[p] - patch.positions[simplified.movedTo[p]]));
        for (const simplify::Triangle& t : patch.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const glm::dvec3 p = patch.positions[t[i]] * (2.0 / 3) + patch.positions[t[(i + 1) % 3]] * (1.0 / 6) +
                                     patch.positions[t[(i + 2) % 3]] * (1.0 / 6);
                const double was = redAt(p, patch, patch.triangles, before);
                maxOff = std::max(maxOff, std::abs(redAt(p, patch, simplified.triangles, after) - was));
            }
        EXPECT_LE(transfer.error, colorCharge(longest, maxOff) * 1.001) << seed;
        EXPECT_GE(transfer.error, colorCharge(kEdge, maxOff) * 0.999) << "nothing moved by less; seed " << seed;
    }
}

} // namespace
} // namespace gnomon::levels
