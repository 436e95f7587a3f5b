// The samples that a list keeps of a batch: which, where, and with what weights.
#include "exact/sample_list.h"
#include "tests/exact/scenes.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace gnomon::exact {
namespace {

constexpr std::int64_t kScale = std::int64_t{1} << kWeightBits;

/// Triangles of coordinates up to `max`, a third of them nearly or quite in the plane of the eye or of the light.
Scene someScene(RandomWholes& random, std::int64_t max, const IntegerLight& light, const glm::i64vec3& eye) {
    Scene scene;
    for (int cluster = 0; cluster < 4; ++cluster) {
        std::vector<Corners> triangles;
        for (int i = 0; i < 80; ++i) {
            Corners corners{random.point(-max, max), random.point(-max, max), random.point(-max, max)};
            const glm::i64vec3 nudge = random.point(-1, 1);
            if (i % 3 == 0) corners[2] = corners[0] + light.direction / std::max<std::int64_t>(1, kScale / max) + nudge;
            if (i % 3 == 1) corners[1] = corners[0] + (eye - corners[0]) / random.whole(1, 4) + nudge;
            triangles.push_back(corners);
        }
        scene.add(triangles);
    }
    for (const std::uint32_t name : scene.names()) {
        ScenePoint point{
            name, static_cast<float>(random.real(0, 1)), 0, 0, static_cast<std::uint32_t>(random.whole(0, 9))};
        point.third = static_cast<float>(random.real(0, 1 - point.second));
        scene.points.push_back(point);
    }
    return scene;
}

bool facesBoth(const Corners& corners, const IntegerLight& light, const glm::i64vec3& scaledEye) {
    return facing(corners, light) * visibleSide(corners, scaledEye) > 0;
}

TEST(SampleList, KeepsWhatFacesEyeAndLightByExactSigns) {
    RandomWholes random(1);
    int unsure = 0;
    int kept = 0;
    for (int i = 0; i < 40; ++i) {
        const std::int64_t max = std::int64_t{1} << random.whole(2, 29);
        const IntegerLight light =
            i % 2 == 0 ? IntegerLight{glm::i64vec3(random.whole(-2, 2), random.whole(-2, 2), 2) * (kScale / 4)}
                       : roundedLight({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
        const glm::i64vec3 eye = random.point(-max, max);
        const Scene scene = someScene(random, max, light, eye);
        const SampleSpace space = spaceOf(light, glm::dvec3(eye));
        std::set<std::uint32_t> facingPoints;
        for (std::size_t p = 0; p < scene.points.size(); ++p)
            if (facesBoth(scene.corners(scene.points[p].triangle), light, eye * kScale))
                facingPoints.insert(static_cast<std::uint32_t>(p));
        ShearedPoints points;
        shearPoints(space, SceneBatch(scene, 0, 128).batch(), points);
        unsure += static_cast<int>(std::count(points.faces.begin(), points.faces.end(), 2));
        tests::onEachTarget([&](const char* target) {
            SCOPED_TRACE(target);
            SampleList samples;
            fill(samples, scene, space);
            EXPECT_EQ(
                std::set<std::uint32_t>(
                    samples.pixel.begin(), samples.pixel.begin() + static_cast<std::ptrdiff_t>(samples.size())),
                facingPoints);
            EXPECT_EQ(samples.size(), facingPoints.size());
        });
        kept += static_cast<int>(facingPoints.size());
    }
    EXPECT_GT(unsure, 50);
    EXPECT_GT(kept, 1000);
}

TEST(SampleList, FewTrianglesNeedIntegersToFace) {
    RandomWholes random(2);
    Scene scene;
    std::vector<Corners> triangles;
    triangles.reserve(85);
    for (int i = 0; i < 85; ++i)
        triangles.push_back({random.point(-999, 999), random.point(-999, 999), random.point(-999, 999)});
    scene.add(triangles);
    for (const std::uint32_t name : scene.names())
        scene.points.push_back({name});
    ShearedPoints points;
    shearPoints(spaceOf(roundedLight({1, 2, 3}), {5, 6, 7}), SceneBatch(scene, 0, 85).batch(), points);
    EXPECT_EQ(std::count(points.faces.begin(), points.faces.begin() + 85, 2), 0);
}

TEST(SampleList, PointsLieWhereTheirWeightsSay) {
    RandomWholes random(3);
    for (int i = 0; i < 40; ++i) {
        const std::int64_t max = std::int64_t{1} << random.whole(0, 29);
        const IntegerLight light = roundedLight({random.real(-1, 1), random.real(-1, 1), random.real(-1, 1)});
        const Scene scene = someScene(random, max, light, glm::i64vec3(3 * max / 2));
        const SampleSpace space = spaceOf(light, glm::dvec3(1.5 * static_cast<double>(max)));
        SampleList samples;
        fill(samples, scene, space);
        const LightShear& shear = space.shear;
        std::int64_t reach = 1;
        for (const std::uint32_t name : scene.names())
            for (const glm::i64vec3& corner : scene.corners(name))
                for (int axis = 0; axis < 3; ++axis)
                    reach = std::max(reach, std::abs(corner[axis]));
        const double error = coordinateErrorFor(static_cast<double>(reach));
        for (std::size_t k = 0; k < samples.size(); ++k) {
            const PointOnTriangle point{scene.corners(samples.triangle[k]), samples.second[k], samples.third[k]};
            const glm::i64vec3 p = scaledPoint(point);
            // With x times the light's largest component, and 64 bits of digits, the shear leaves no fraction.
            const auto exact = [&](int axis) {
                const auto along = static_cast<long double>(light.direction[shear.along]);
                const long double across =
                    static_cast<long double>(p[axis]) -
                    static_cast<long double>(p[shear.along]) * static_cast<long double>(light.direction[axis]) / along;
                return across / static_cast<long double>(kScale);
            };
            EXPECT_LE(std::abs(static_cast<double>(samples.u[k] - exact(shear.first))), error);
            EXPECT_LE(std::abs(static_cast<double>(samples.v[k] - exact(shear.second))), error);
            const double h = shear.sign * static_cast<double>(p[shear.along]) * 0x1p-24;
            EXPECT_LE(std::abs(samples.h[k] - h), error);
            const ScenePoint& from = scene.points[samples.pixel[k]];
            EXPECT_EQ(samples.triangle[k], from.triangle);
            EXPECT_EQ(samples.tolerance[k], from.tolerance);
            EXPECT_EQ(samples.perTolerance(), shear.component * 0x1p-24);
        }
    }
}

TEST(SampleList, WeightsStayWithinTheTriangle) {
    RandomWholes random(4);
    std::vector<std::array<float, 2>> weights = {
        {0, 0}, {1, 0}, {0, 1}, {0.5F, 0.5F}, {1, 1}, {-1, 2}, {0x1p-30F, 1}, {1 - 0x1p-24F, 0x1p-24F}};
    for (int i = 0; i < 80; ++i) {
        const double second = random.real(0, 1);
        weights.push_back({static_cast<float>(second), static_cast<float>(1 - second)});
    }
    Scene scene;
    const std::uint32_t name =
        scene.add(std::vector<Corners>{{glm::i64vec3(0), glm::i64vec3(9, 0, 0), glm::i64vec3(0, 9, 0)}});
    for (const auto& [second, third] : weights)
        scene.points.push_back({name, second, third});
    tests::onEachTarget([&](const char* target) {
        SCOPED_TRACE(target);
        SampleList samples;
        fill(samples, scene, spaceOf(roundedLight({0, 0, 1}), {1, 1, 9}));
        ASSERT_EQ(samples.size(), weights.size());
        for (std::size_t i = 0; i < weights.size(); ++i) {
            const auto& [second, third] = weights[samples.pixel[i]];
            const IntegerWeights rounded = roundedWeights(second, third);
            EXPECT_EQ(samples.second[i], rounded.second);
            EXPECT_EQ(samples.third[i], rounded.third);
            EXPECT_GE(rounded.second, 1U);
            EXPECT_GE(rounded.third, 1U);
            EXPECT_LT(std::uint64_t{rounded.second} + rounded.third, std::uint64_t{kScale});
            if (second < 0 || second + third > 1 + 0x1p-23F) continue;
            EXPECT_LE(std::abs(rounded.second - second * 0x1p24), 2);
            EXPECT_LE(std::abs(rounded.third - third * 0x1p24), 2);
        }
    });
}

TEST(SampleList, BatchesOfManyThreadsGiveTheSameSet) {
    RandomWholes random(5);
    const IntegerLight light = roundedLight({1, -2, 3});
    const Scene scene = someScene(random, 1000, light, glm::i64vec3(500));
    const SampleSpace space = spaceOf(light, glm::dvec3(500));
    SampleList alone;
    fill(alone, scene, space);
    SampleList samples;
    for (int round = 0; round < 20; ++round) {
        samples.reset(space, scene.points.size());
        constexpr std::size_t kBatch = 5;
        tbb::parallel_for(std::size_t{0}, scene.points.size() / kBatch, [&](std::size_t i) {
            samples.add(SceneBatch(scene, i * kBatch, (i + 1) * kBatch).batch());
        });
        ASSERT_EQ(samples.size(), alone.size());
        std::vector<std::size_t> order(samples.size());
        for (std::size_t i = 0; i < order.size(); ++i)
            order[i] = i;
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return samples.pixel[a] < samples.pixel[b];
        });
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t k = order[i];
            const bool isSame = samples.pixel[k] == alone.pixel[i] && samples.u[k] == alone.u[i] &&
                                samples.v[k] == alone.v[i] && samples.h[k] == alone.h[i] &&
                                samples.second[k] == alone.second[i] && samples.third[k] == alone.third[i] &&
                                samples.triangle[k] == alone.triangle[i] && samples.mapOf(k) == alone.mapOf(i);
            wrong += isSame ? 0U : 1U;
        }
        EXPECT_EQ(wrong, 0U);
    }
}

TEST(SampleList, HoldsMapsToThoseThatThereAre) {
    Scene scene;
    const std::uint32_t name =
        scene.add(std::vector<Corners>{{glm::i64vec3(0), glm::i64vec3(9, 0, 0), glm::i64vec3(0, 9, 0)}});
    for (const int map : {-1, 0, 2, 3, 99})
        scene.points.push_back({name, 0.25F, 0.25F, map});
    SampleList samples;
    fill(samples, scene, spaceOf(roundedLight({0, 0, 1}), {1, 1, 9}, 3));
    ASSERT_EQ(samples.size(), 5U);
    EXPECT_EQ(
        std::vector<std::int32_t>(samples.map.begin(), samples.map.begin() + 5),
        (std::vector<std::int32_t>{0, 0, 2, 2, 2}));
}

} // namespace
} // namespace gnomon::exact
