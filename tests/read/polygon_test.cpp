// Polygons become triangles that cover them exactly: areas, orientations and point-in-polygon tests by hand.
#include "core/random.h"
#include "preprocess/read/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

namespace gnomon::read {
namespace {

using Loop = std::vector<glm::dvec2>;

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double area(const Loop& loop) {
    double sum = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        sum += cross({0, 0}, loop[i], loop[(i + 1) % loop.size()]) / 2;
    return sum;
}

// Even-odd rule by a ray.
bool isInside(const Loop& loop, const glm::dvec2& p) {
    bool inside = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const glm::dvec2& a = loop[i];
        const glm::dvec2& b = loop[(i + 1) % loop.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) inside = !inside;
    }
    return inside;
}

std::vector<PolygonTriangle> triangulate(const Loop& loop, const glm::dmat3& frame, const glm::dvec3& origin) {
    std::vector<glm::dvec3> corners;
    for (const glm::dvec2& p : loop)
        corners.push_back(origin + frame * glm::dvec3(p, 0));
    std::vector<PolygonTriangle> triangles;
    NoProgress unwatched;
    triangulatePolygon(corners, triangles, unwatched);
    return triangles;
}

// Every point of the polygon lies in exactly one triangle, every other point in none.
void expectCovers(const Loop& loop, const std::vector<PolygonTriangle>& triangles, std::uint64_t seed) {
    ASSERT_EQ(triangles.size(), loop.size() - 2);
    double sum = 0;
    for (const PolygonTriangle& t : triangles) {
        const double twice = cross(loop[t[0]], loop[t[1]], loop[t[2]]);
        EXPECT_GE(twice, 0);
        sum += twice / 2;
    }
    EXPECT_NEAR(sum, area(loop), 1e-9 * area(loop));
    Random random(seed);
    for (int n = 0; n < 300; ++n) {
        const glm::dvec2 p(random.uniform(-1.1, 1.1), random.uniform(-1.1, 1.1));
        int hits = 0;
        for (const PolygonTriangle& t : triangles) {
            const Loop corner = {loop[t[0]], loop[t[1]], loop[t[2]]};
            hits += isInside(corner, p) ? 1 : 0;
        }
        EXPECT_EQ(hits, isInside(loop, p) ? 1 : 0) << p.x << " " << p.y;
    }
}

const std::vector<glm::dmat3> kFrames = {
    glm::dmat3(1),
    glm::dmat3(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0)),
    glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0)),
    glm::dmat3(glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, -1)),
    glm::dmat3(glm::dvec3(0.6, 0, 0.8), glm::dvec3(0, 1, 0), glm::dvec3(-0.8, 0, 0.6))};

void expectCoversInEveryFrame(const Loop& loop) {
    ASSERT_GT(area(loop), 0);
    for (const glm::dmat3& frame : kFrames)
        for (const double distance : {0.0, 1024.0})
            expectCovers(loop, triangulate(loop, frame, glm::dvec3(distance)), 7);
}

TEST(ReadPolygon, AConvexOneIsItsFan) {
    const Loop square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<PolygonTriangle> fan = {{0, 1, 2}, {0, 2, 3}};
    for (const glm::dmat3& frame : kFrames)
        EXPECT_EQ(triangulate(square, frame, glm::dvec3(0)), fan);
}

TEST(ReadPolygon, EveryRotationOfADart) {
    Loop dart = {{-1, -1}, {0, -0.2}, {1, -1}, {0, 1}};
    for (int i = 0; i < 4; ++i) {
        expectCoversInEveryFrame(dart);
        std::rotate(dart.begin(), dart.begin() + 1, dart.end());
    }
}

TEST(ReadPolygon, LettersAndCombs) {
    expectCoversInEveryFrame({{-1, -1}, {1, -1}, {1, -0.5}, {-0.5, -0.5}, {-0.5, 1}, {-1, 1}});
    Loop comb;
    for (int i = 0; i < 40; ++i) {
        comb.emplace_back(1 - i * 0.05, i % 2 == 0 ? 1 : -0.9);
    }
    comb.emplace_back(-1, -1);
    comb.emplace_back(1, -1);
    expectCoversInEveryFrame(comb);
}

TEST(ReadPolygon, CornersOnStraightEdges) {
    expectCoversInEveryFrame({{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}});
    expectCoversInEveryFrame({{0, -1}, {1, -1}, {0, 1}, {-1, -1}});
}

TEST(ReadPolygon, AHoleOnABridge) {
    expectCoversInEveryFrame(
        {{-1, -1},
         {1, -1},
         {1, 1},
         {-1, 1},
         {-1, -1},
         {-0.5, -0.5},
         {-0.5, 0.5},
         {0.5, 0.5},
         {0.5, -0.5},
         {-0.5, -0.5}});
}

TEST(ReadPolygon, HolesOnBridgesFromEveryStart) {
    // Two square holes; both bridges leave from the corner at the lower left.
    Loop loop = {
        {-1, -1},
        {-0.9, 0.2},
        {-0.9, 0.9},
        {-0.2, 0.9},
        {-0.2, 0.2},
        {-0.9, 0.2},
        {-1, -1},
        {0.2, -0.9},
        {0.2, -0.2},
        {0.9, -0.2},
        {0.9, -0.9},
        {0.2, -0.9},
        {-1, -1},
        {1, -1},
        {1, 1},
        {-1, 1}};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        expectCoversInEveryFrame(loop);
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

TEST(ReadPolygon, ATipThatTouchesACornerFromInside) {
    Loop loop = {{-1, -1}, {1, -1}, {1, 0.9}, {-1, -1}, {0.9, 1}, {-1, 1}};
    for (std::size_t i = 0; i < loop.size(); ++i) {
        expectCoversInEveryFrame(loop);
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    }
}

TEST(ReadPolygon, RandomStarsAndSpirals) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const std::size_t n = 4 + random.below(60);
        Loop star;
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
            star.push_back(random.uniform(0.1, 1.0) * glm::dvec2(std::cos(angle), std::sin(angle)));
        }
        expectCovers(star, triangulate(star, kFrames[0], glm::dvec3(0)), seed);
    }
    Loop spiral;
    for (int i = 0; i <= 100; ++i)
        spiral.push_back((0.1 + i * 0.008) * glm::dvec2(std::cos(i * 0.2), std::sin(i * 0.2)));
    for (int i = 100; i >= 0; --i)
        spiral.push_back((0.05 + i * 0.008) * glm::dvec2(std::cos(i * 0.2), std::sin(i * 0.2)));
    std::reverse(spiral.begin(), spiral.end());
    if (area(spiral) < 0) std::reverse(spiral.begin(), spiral.end());
    expectCovers(spiral, triangulate(spiral, kFrames[0], glm::dvec3(0)), 5);
}

TEST(ReadPolygon, BadLoopsStillGiveAllTriangles) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const std::size_t n = 3 + random.below(30);
        std::vector<glm::dvec3> corners;
        for (std::size_t i = 0; i < n; ++i)
            corners.emplace_back(random.below(4), random.below(3), seed % 2 == 0 ? 0 : random.below(3));
        if (seed % 5 == 0) corners.assign(n, corners[0]);
        if (seed % 7 == 0) corners[0] = glm::dvec3(1e308, -1e308, 1e308);
        std::vector<PolygonTriangle> triangles;
        NoProgress unwatched;
        triangulatePolygon(corners, triangles, unwatched);
        EXPECT_EQ(triangles.size(), n - 2);
        for (const PolygonTriangle& t : triangles)
            EXPECT_EQ((std::set<std::uint32_t>{t[0], t[1], t[2]}).size(), 3U);
    }
}

// Quadratic search would take minutes here.
TEST(ReadPolygon, HugeLoopsEnd) {
    constexpr std::size_t kCorners = 200'000;
    Random random(11);
    Loop star;
    Loop tangle;
    for (std::size_t i = 0; i < kCorners; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kCorners);
        star.push_back(random.uniform(0.9, 1.0) * glm::dvec2(std::cos(angle), std::sin(angle)));
        if (i < kCorners / 40) tangle.emplace_back(random.unit(), random.unit());
    }
    const std::vector<PolygonTriangle> triangles = triangulate(star, kFrames[0], glm::dvec3(0));
    ASSERT_EQ(triangles.size(), kCorners - 2);
    double sum = 0;
    for (const PolygonTriangle& t : triangles) {
        const double twice = cross(star[t[0]], star[t[1]], star[t[2]]);
        EXPECT_GE(twice, 0);
        sum += twice / 2;
    }
    EXPECT_NEAR(sum, area(star), 1e-9);
    EXPECT_EQ(triangulate(tangle, kFrames[0], glm::dvec3(0)).size(), tangle.size() - 2);
}

/// Counts how often it is asked, and stops the work at the first time if told so.
class Poll final : public Progress {
public:
    explicit Poll(bool stops) : stops_(stops) {}

    void stage(std::string_view /*name*/, std::string_view /*unit*/, std::uint64_t /*total*/) override {}

    void advance(std::uint64_t /*count*/) override {
        ++asked;
        if (stops_) throw Interrupted{};
    }

    int asked = 0;

private:
    bool stops_;
};

TEST(ReadPolygon, ALoopThatCrossesItselfEverywhereIsGivenUpSoonAndCanBeStopped) {
    constexpr std::size_t kCorners = 50'000;
    Random random(5);
    std::vector<glm::dvec3> corners;
    for (std::size_t i = 0; i < kCorners; ++i)
        corners.emplace_back(random.unit(), random.unit(), 0);
    std::vector<PolygonTriangle> triangles;
    Poll counting(false);
    triangulatePolygon(corners, triangles, counting);
    EXPECT_EQ(triangles.size(), kCorners - 2);
    EXPECT_GE(counting.asked, 2);
    EXPECT_LE(counting.asked, 8); // once in four million steps; the search for real loops would go on for 120 of them
    Poll stopping(true);
    triangles.clear();
    EXPECT_THROW(triangulatePolygon(corners, triangles, stopping), Interrupted);
}

// The triangles of its long teeth meet each row of any grid.
TEST(ReadPolygon, ACombOfManyTeethIsCutInFewSteps) {
    constexpr int kCorners = 100'000;
    std::vector<glm::dvec3> corners{{-10, -10, 0}, {kCorners, -10, 0}};
    for (int i = kCorners - 3; i >= 0; --i)
        corners.emplace_back(i / 2, (i % 4 == 0 || i % 4 == 3 ? 0 : 1e6) + 0.01 * (i % 7), 0);
    std::vector<PolygonTriangle> triangles;
    Poll counting(false);
    triangulatePolygon(corners, triangles, counting);
    ASSERT_EQ(triangles.size(), corners.size() - 2);
    EXPECT_LE(counting.asked, 4); // once in four million steps
    double sum = 0;
    for (const PolygonTriangle& t : triangles) {
        const double twice = cross(corners[t[0]], corners[t[1]], corners[t[2]]);
        EXPECT_GE(twice, 0);
        sum += twice / 2;
    }
    EXPECT_NEAR(sum / area(Loop(corners.begin(), corners.end())), 1, 1e-12);
}

TEST(ReadPolygon, TheRefinerRewritesAFanInPlace) {
    const std::vector<glm::dvec3> positions = {{9, 9, 9}, {-1, -1, 0}, {0, -0.2, 0}, {1, -1, 0}, {0, 1, 0}};
    std::vector<TriangleCorners> fan = {{4, 1, 2}, {4, 2, 3}};
    NoProgress unwatched;
    PolygonRefiner refiner(unwatched);
    refiner.refine(fan, [&](std::uint64_t vertex) { return positions[vertex]; });
    double sum = 0;
    for (const TriangleCorners& t : fan) {
        const double twice = cross(positions[t[0]], positions[t[1]], positions[t[2]]);
        EXPECT_GT(twice, 0);
        sum += twice / 2;
    }
    EXPECT_NEAR(sum, area({{-1, -1}, {0, -0.2}, {1, -1}, {0, 1}}), 1e-12);

    fan = {{1, 2, 3}, {1, 3, 4}};
    refiner.refine(fan, [&](std::uint64_t vertex) { return positions[vertex]; });
    for (const TriangleCorners& t : fan)
        EXPECT_GT(cross(positions[t[0]], positions[t[1]], positions[t[2]]), 0);
}

} // namespace
} // namespace gnomon::read
