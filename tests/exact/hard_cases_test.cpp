// The hard cases of exact shadows, one check each; docs/hard_cases.md shows this table.
#include "tests/exact/scenes.h"
#include "tests/support/hard_cases.h"

#include <gtest/gtest.h>

namespace gnomon::exact {
namespace {

using Vec = glm::i64vec3;

constexpr std::int64_t kUp = (std::int64_t{1} << kLightBits) - 1;
const IntegerLight kUpright{{0, 0, kUp}};
const std::vector<glm::dmat3> kNoWarp{glm::dmat3(1)};

/// Two triangles over the rectangle from (x0, y0) to (x1, y1) at height z, seen and lit from above.
std::vector<Corners> sheet(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1, std::int64_t z) {
    const Vec a(x0, y0, z);
    const Vec b(x1, y0, z);
    const Vec c(x1, y1, z);
    const Vec d(x0, y1, z);
    return {{a, b, c}, {a, c, d}};
}

/// Points that cover triangle `name`, in steps of an eighth.
void addPoints(Scene& scene, std::uint32_t name, std::uint32_t tolerance = 0) {
    for (int second = 1; second < 8; ++second)
        for (int third = 1; second + third < 8; ++third)
            scene.points.push_back({name, static_cast<float>(second) / 8, static_cast<float>(third) / 8, 0, tolerance});
}

void ownTriangleAndNeighbours() {
    // A valley of which both sides see the light, a ridge, and both at the largest and at slanted lights.
    for (const std::int64_t height : {9, -9})
        for (const std::int64_t size : {1, 1000, 1 << 24}) {
            Scene scene;
            const Vec a(0, 0, 0);
            const Vec b(0, 9 * size, 0);
            scene.add(std::vector<Corners>{
                {b, a, Vec(9 * size, 0, height * size)}, {a, b, Vec(-9 * size, 0, height * size)}});
            addPoints(scene, 0);
            addPoints(scene, 1);
            for (const Vec direction : {Vec(0, 0, kUp), Vec(kUp / 3, 5, kUp), Vec(-kUp / 4, kUp / 2, kUp)}) {
                const auto found =
                    expectSameAsPlain(scene, spaceOf({direction}, glm::dvec3(0, 0, 100 * size)), kNoWarp, 8);
                EXPECT_EQ(found.samples, 42U);
                EXPECT_EQ(found.darkWithoutTolerance, 0U);
            }
        }
}

/// A floor of points on whole cells under a caster; the dark ones' number, none of which may be touching unless on a
/// tie.
ExactStatistics under(const std::vector<Corners>& casters) {
    Scene scene;
    scene.add(std::vector<Corners>{{Vec(0, 0, 0), Vec(8, 0, 0), Vec(0, 8, 0)}});
    addPoints(scene, 0); // at (1..6, 1..6), x + y < 8
    scene.add(casters);
    return expectSameAsPlain(scene, spaceOf(kUpright, {1, 1, 99}), kNoWarp, 8);
}

void samplesUnderAnEdge() {
    // The diagonal of the sheet runs over samples; so do its sides, which belong to one of two sheets that share one.
    EXPECT_EQ(under(sheet(-1, -1, 9, 9, 5)).dark, 21U);
    EXPECT_GT(under(sheet(-1, -1, 9, 9, 5)).withinTolerance, 0U);
    const std::uint64_t left = under(sheet(-1, -1, 3, 9, 5)).dark;
    const std::uint64_t right = under(sheet(3, -1, 9, 9, 5)).dark;
    EXPECT_EQ(left + right, 21U);
}

void samplesUnderAVertex() {
    // Eight triangles around (2, 2): together they cover all, one by one each sample once.
    const Vec hub(2, 2, 5);
    const std::vector<Vec> rim = {
        {99, 2, 5}, {99, 99, 5}, {2, 99, 5}, {-99, 99, 5}, {-99, 2, 5}, {-99, -99, 5}, {2, -99, 5}, {99, -99, 5}};
    std::vector<Corners> fan;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        fan.push_back({hub, rim[i], rim[(i + 1) % rim.size()]});
        sum += under({fan.back()}).dark;
    }
    EXPECT_EQ(under(fan).dark, 21U);
    EXPECT_EQ(sum, 21U);
}

void samplesUnderATJunction() {
    // One edge over two half as long: no leak where the third vertex is on it, a crack where it is one cell off.
    std::vector<Corners> junction{
        {Vec(-99, 3, 5), Vec(99, 3, 5), Vec(0, 99, 5)},
        {Vec(99, 3, 5), Vec(3, 3, 5), Vec(0, -99, 5)},
        {Vec(3, 3, 5), Vec(-99, 3, 5), Vec(0, -99, 5)}};
    EXPECT_EQ(under(junction).dark, 21U);
    junction[1][1].y = junction[2][0].y = 1;
    const std::uint64_t cracked = under(junction).dark;
    EXPECT_LT(cracked, 21U);
    EXPECT_GT(cracked, 10U);
}

void coincidentSheets() {
    Scene scene;
    for (int copy = 0; copy < 3; ++copy)
        scene.add(sheet(0, 0, 16, 16, 7));
    scene.add(std::vector<Corners>{{Vec(16, 16, 7), Vec(0, 0, 7), Vec(16, 0, 7)}}); // one turned over
    for (const std::uint32_t name : {0U, 1U, 256U, 513U, 768U})
        addPoints(scene, name);
    const auto found = expectSameAsPlain(scene, spaceOf({{kUp / 7, kUp / 5, kUp}}, {1, 1, 99}), kNoWarp, 8);
    EXPECT_EQ(found.samples, 105U);
    EXPECT_EQ(found.darkWithoutTolerance, 0U);
}

void casterTouchingTheReceiver() {
    // A wall that stands on x = 8, its foot in the floor; light from +x.
    Scene scene;
    scene.add(sheet(0, 0, 16, 16, 0));
    scene.add(std::vector<Corners>{
        {Vec(8, 0, 0), Vec(8, 16, 0), Vec(8, 16, 5)}, {Vec(8, 0, 0), Vec(8, 16, 5), Vec(8, 0, 5)}});
    addPoints(scene, 0); // x from 4 to 14 in steps of 2
    const auto found = expectSameAsPlain(scene, spaceOf({{kUp, 0, kUp}}, {1, 1, 99}), kNoWarp, 16);
    std::uint64_t behind = 0;
    for (const ScenePoint& point : scene.points) {
        const double x = 16 * (point.second + point.third);
        behind += x < 8 ? 1U : 0U;
    }
    EXPECT_EQ(found.samples, 21U);
    EXPECT_EQ(found.dark, behind);
}

void grazingLight() {
    // A floor that rises by one cell in 2^26 towards a light that rises by half as much more.
    constexpr std::int64_t kLong = 1 << 26;
    Scene scene;
    scene.add(std::vector<Corners>{
        {Vec(0, 0, 0), Vec(kLong, 0, 1), Vec(0, kLong, 0)},
        {Vec(kLong, 0, 1), Vec(kLong, kLong, 1), Vec(0, kLong, 0)}});
    addPoints(scene, 0);
    addPoints(scene, 1);
    for (const std::int64_t rise : {1, 2, 5}) {
        const auto found = expectSameAsPlain(scene, spaceOf({{kUp, 0, rise}}, {0, 0, 99}), kNoWarp, 8);
        EXPECT_EQ(found.samples, 42U);
        EXPECT_EQ(found.dark, 0U);
    }
    EXPECT_EQ(expectSameAsPlain(scene, spaceOf({{kUp, 0, 0}}, {0, 0, 99}), kNoWarp, 8).samples, 0U);
    // A step of one cell at the far end throws its shadow over all of it.
    scene.add(std::vector<Corners>{{Vec(kLong, -kLong, 0), Vec(kLong, 2 * kLong, 0), Vec(kLong, kLong / 2, 999)}});
    const auto found = expectSameAsPlain(scene, spaceOf({{kUp, 0, 1}}, {0, 0, 99}), kNoWarp, 8);
    EXPECT_EQ(found.dark, 42U);
}

void lightInThePlaneOfAFace() {
    // A box over the floor, its walls along the light: only its top and bottom cast.
    Scene scene;
    scene.add(sheet(0, 0, 64, 64, 0));
    const std::vector<Corners> top = sheet(8, 8, 40, 40, 20);
    std::vector<Corners> box = sheet(8, 8, 40, 40, 10);
    box.insert(box.end(), top.begin(), top.end());
    const std::array<Vec, 4> low{Vec(8, 8, 10), Vec(40, 8, 10), Vec(40, 40, 10), Vec(8, 40, 10)};
    std::vector<Corners> walls;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec a = low[i];
        const Vec b = low[(i + 1) % 4];
        walls.push_back({a, b, b + Vec(0, 0, 10)});
        walls.push_back({a, b + Vec(0, 0, 10), a + Vec(0, 0, 10)});
    }
    addPoints(scene, 0);
    addPoints(scene, 1);
    Scene withWalls = scene;
    scene.add(box);
    withWalls.add(box);
    withWalls.add(walls);
    const SampleSpace space = spaceOf(kUpright, {1, 1, 99});
    const auto without = expectSameAsPlain(scene, space, kNoWarp, 8);
    const auto with = expectSameAsPlain(withWalls, space, kNoWarp, 8);
    EXPECT_GT(without.dark, 5U);
    EXPECT_EQ(with.dark, without.dark);
    EXPECT_EQ(with.withinTolerance, without.withinTolerance);
    EXPECT_EQ(with.counts.exactDecisions, without.counts.exactDecisions);
}

void trianglesThroughTheWarpsCentre() {
    // w is 0 at u = -50: roofs reach far behind it, on one side or on both.
    const glm::dmat3 warp{{1, 0, 0.02}, {0, 1, 0}, {0, 0, 1}};
    for (const std::int64_t far : {-60, -1000, -1000000})
        for (const std::int64_t near : {-55, -45, 0, 20, 1000000}) {
            Scene scene;
            scene.add(sheet(0, 0, 16, 16, 0));
            addPoints(scene, 0);
            addPoints(scene, 1);
            scene.add(sheet(far, -5, near, 9, 5));
            expectSameAsPlain(scene, spaceOf(kUpright, {1, 1, 99}), {warp}, 16);
        }
}

void aThousandSamplesInOneCell() {
    // All but two lie within a millionth of the grid's width.
    RandomWholes random(1);
    Scene scene;
    scene.add(std::vector<Corners>{{Vec(0, 0, 0), Vec(1 << 20, 0, 0), Vec(0, 1 << 20, 0)}});
    for (int i = 0; i < 1000; ++i)
        scene.points.push_back(
            {0, 0.25F + static_cast<float>(random.real(0, 1e-6)), 0.25F + static_cast<float>(random.real(0, 1e-6))});
    scene.points.push_back({0, 0, 0});
    scene.points.push_back({0, 0.5F, 0.5F});
    scene.add(std::vector<Corners>{{Vec(262144, 262144, 9), Vec(262145, 262150, 9), Vec(262150, 262145, 9)}});
    const auto found = expectSameAsPlain(scene, spaceOf(kUpright, {1, 1, 99}), kNoWarp, 64);
    EXPECT_GT(found.dark, 300U);
    EXPECT_LT(found.dark, 1000U);
    EXPECT_EQ(found.counts.sampleTests, 2002U); // of the floor with all, of the caster with those of its cell
}

void aSampleThatChangesItsMap() {
    // The same points, in one map, in the other, or in both by turns.
    const std::vector<glm::dmat3> planes{{{1, 0, 0.01}, {0, 1, 0}, {0, 0, 1}}, {{0, 3, 0}, {3, 0, 0.01}, {0, 0, 1}}};
    std::vector<std::uint64_t> dark;
    for (int kind = 0; kind < 3; ++kind) {
        RandomWholes random(1);
        Scene scene;
        scene.add(sheet(0, 0, 16, 16, 0));
        addPoints(scene, 0);
        addPoints(scene, 1);
        for (std::size_t i = 0; i < scene.points.size(); ++i)
            scene.points[i].map = kind < 2 ? kind : static_cast<std::int32_t>(i % 2);
        std::vector<Corners> roofs;
        roofs.reserve(8);
        for (int i = 0; i < 8; ++i)
            roofs.push_back({random.point(2, 14), random.point(2, 14), random.point(2, 14)});
        scene.add(roofs);
        dark.push_back(expectSameAsPlain(scene, spaceOf(kUpright, {1, 1, 99}, 2), planes, 8).dark);
    }
    EXPECT_GT(dark[0], 0U);
    EXPECT_EQ(dark[0], dark[1]);
    EXPECT_EQ(dark[0], dark[2]);
}

constexpr std::array kCases = {
    HardCase{
        "the receiver's own triangle and its neighbours at an edge",
        "a point rounded to the grid lies beside its triangle: no offset suits all sizes, or edges show acne",
        ownTriangleAndNeighbours},
    HardCase{
        "samples under a shared edge",
        "light leaks between the two triangles, or both of them hit the ray",
        samplesUnderAnEdge},
    HardCase{
        "samples under a vertex",
        "all triangles around the vertex miss the ray, or all of them hit it",
        samplesUnderAVertex},
    HardCase{
        "samples under a T-junction",
        "the long edge and its two halves round differently; a true crack beside the edge is closed",
        samplesUnderATJunction},
    HardCase{"coincident sheets", "by rounding, each sheet shadows parts of the other", coincidentSheets},
    HardCase{
        "a caster that touches its receiver",
        "a bias moves its shadow away from its foot, and light leaks in along the wall",
        casterTouchingTheReceiver},
    HardCase{
        "grazing light",
        "rounding decides which side faces the light, and a small offset along the ray is long on the surface",
        grazingLight},
    HardCase{
        "a caster with the light in its plane",
        "its shadow is a line of no width: its edge functions are all 0, and its depth is 0 / 0",
        lightInThePlaneOfAFace},
    HardCase{
        "a caster through the warp's plane w = 0",
        "after a division by w on both sides of 0, it covers the wrong cells",
        trianglesThroughTheWarpsCentre},
    HardCase{
        "a thousand samples in one cell", "a list of fixed length loses the last samples", aThousandSamplesInOneCell},
    HardCase{
        "a sample that changes its map by a rounding",
        "a result from texels or floats of the map changes too: wrong pixels form a moving line",
        aSampleThatChangesItsMap},
};

TEST(HardCases, HoldAndAreInTheDocument) {
    runHardCases(GNOMON_SOURCE_DIR, "Exact shadows", kCases);
}

} // namespace
} // namespace gnomon::exact
