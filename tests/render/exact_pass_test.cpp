// What exact shadows take of a frame: tolerances, casters, and how the light plane lies over the cells.
#include "core/error.h"
#include "gl/shader_library.h"
#include "render/exact_pass.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "tests/support/field.h"
#include "tests/support/tested_platform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace gnomon::render {
namespace {

plan::Quality exactQuality() {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    return quality;
}

/// A frame of the field, as a renderer hands it to an backend.
class ExactFrame {
public:
    explicit ExactFrame(std::uint64_t seed, const plan::Quality& quality = exactQuality())
        : plan_(field().plan(field().view(seed), quality)), drawing_(field().drawing(plan_)) {
        drawing_.exactCasters = drawing_.image;
    }

    const DrawInputs& drawing() const { return drawing_; }

    DrawInputs& drawing() { return drawing_; }

    static const Field& field() {
        static const Field field;
        return field;
    }

private:
    plan::FramePlan plan_;
    DrawInputs drawing_;
};

TEST(ExactPass, ATouchIsTwoStepsAway) {
    for (const glm::dvec3& towards : {glm::dvec3(0, 1, 0), glm::dvec3(1, 1, 1), glm::dvec3(0.3, -0.9, 0.2)}) {
        const IntegerLight light = roundedLight(towards);
        const std::uint32_t found = tolerance(light);
        // As `intersect` has it: P + t * direction / 2^24 lies `t * |direction| / 2^24` cells ahead.
        const double cells = glm::length(glm::dvec3(light.direction)) / 0x1p24;
        EXPECT_LE(found * cells, 2);
        EXPECT_GT((found + 1.0) * cells, 2 - 1e-12);
    }
}

TEST(ExactPass, EachCasterIsThereOnceAndTheImagesComeFirst) {
    ExactFrame frame(4);
    // The image draws some clusters; the others, and some of its own, can cast.
    const lod::DrawList& all = *frame.drawing().image;
    lod::DrawList image;
    for (std::size_t i = 0; i < all.ranges.size(); ++i)
        if (i % 2 == 0 && all.ranges[i].clusterCount > 2)
            image.ranges.push_back({all.ranges[i].page, 1, all.ranges[i].clusterCount - 2});
    frame.drawing().image = &image;
    SoftwarePass pass;
    pass.gather(frame.drawing(), image, Cutting::Whole);
    std::vector<exact::Caster> casters;
    gatherExactCasters(frame.drawing(), pass, casters);
    ASSERT_GT(pass.drawn().size(), 10U);
    std::size_t clusters = 0;
    for (const lod::ClusterRange& range : all.ranges)
        clusters += range.clusterCount;
    EXPECT_EQ(casters.size(), clusters);
    std::set<const void*> triangles;
    for (std::size_t i = 0; i < casters.size(); ++i) {
        EXPECT_EQ(casters[i].geometry.firstTriangleId, i << kTriangleBits);
        EXPECT_TRUE(triangles.insert(casters[i].geometry.triangles.data()).second) << i;
        exact::CasterContext context;
        const hierarchy::GridPoint origin = frame.drawing().space.originCell;
        context.originCell = {origin.x, origin.y, origin.z};
        for (std::size_t t = 0; t < casters[i].geometry.triangles.size(); ++t)
            for (const glm::i64vec3& corner : exact::cornersOf(context, casters[i], t)) {
                EXPECT_TRUE(glm::all(glm::lessThanEqual(casters[i].min, corner)));
                EXPECT_TRUE(glm::all(glm::lessThanEqual(corner, casters[i].max)));
            }
    }
    for (std::size_t i = 0; i < pass.drawn().size(); ++i) {
        EXPECT_EQ(casters[i].geometry.triangles.data(), pass.clusters()[i].triangles.data());
        EXPECT_EQ(casters[i].geometry.firstTriangleId, pass.clusters()[i].firstTriangleId);
    }
}

TEST(ExactPass, WhatLiesAlongTheLightLandsOnOnePlace) {
    for (std::uint64_t seed = 1; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        const ExactFrame frame(seed);
        const exact::SampleSpace space = sampleSpace(frame.drawing());
        const std::vector<glm::dmat3> planes = cellPlanes(frame.drawing(), space.shear);
        const plan::FramePlan& plan = *frame.drawing().plan;
        ASSERT_EQ(planes.size(), plan.sampleGridMaps.size());
        ASSERT_FALSE(planes.empty());
        EXPECT_EQ(space.maps, static_cast<int>(planes.size()));
        EXPECT_EQ(space.light, plan.light);
        const glm::dmat4 clipFromDraw =
            plan.sampleGridMaps[0].lightClipFromCamera() * frame.drawing().space.cameraFromDraw;
        const glm::dvec3 light(space.light.direction);
        const Box& bounds = ExactFrame::field().model().summary.bounds;
        const double size = glm::length(bounds.extent()) / frame.drawing().space.step; // cells
        int compared = 0;
        for (int i = 0; i < 40; ++i) {
            const glm::dvec3 cell =
                glm::dvec3(std::sin(7.0 * i), 0.1 * std::sin(3.0 * i), std::cos(5.0 * i)) * size * 0.5;
            const auto onPlane = [&](const glm::dvec3& p) {
                const exact::LightShear& shear = space.shear;
                const glm::dvec2 uv(
                    p[shear.first] - shear.firstRatio * p[shear.along],
                    p[shear.second] - shear.secondRatio * p[shear.along]);
                return planes[0] * glm::dvec3(uv, 1);
            };
            const glm::dvec3 here = onPlane(cell);
            const glm::dvec3 ahead = onPlane(cell + light / glm::length(light) * size * 0.3);
            EXPECT_NEAR(glm::length(here - ahead), 0, 1e-9 * glm::length(here));
            const glm::dvec4 clip = clipFromDraw * glm::dvec4(cell * frame.drawing().space.step, 1);
            if (clip.w <= 1e-3) continue;
            ++compared;
            const glm::dvec2 expected = glm::dvec2(clip) / clip.w;
            EXPECT_NEAR(here.x / here.z, expected.x, 1e-9 * (1 + std::abs(expected.x)));
            EXPECT_NEAR(here.y / here.z, expected.y, 1e-9 * (1 + std::abs(expected.y)));
        }
        EXPECT_GT(compared, 5);
    }
}

TEST(ExactPass, OpenGlRefusesIt) {
    const ExactFrame frame(5);
    const std::unique_ptr<Backend> gl = makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(16));
    EXPECT_FALSE(gl->capabilities().exactShadows);
    try {
        gl->drawExactly(frame.drawing());
        FAIL() << "it draws";
    } catch (const Error& error) {
        EXPECT_EQ(
            error.what(),
            "exact shadows: this backend does not support them: expected the software backend, found " + gl->name());
    }
}

TEST(ExactPass, WhatItHoldsIsCounted) {
    const ExactFrame frame(6);
    const std::unique_ptr<Backend> backend = makeSoftwareBackend();
    const DrawStatistics drawn = backend->drawExactly(frame.drawing());
    ASSERT_TRUE(drawn.exact);
    ASSERT_GT(drawn.exact->samples, 1000U);
    EXPECT_EQ(drawn.deviceMemory.count, backend->deviceMemory().count);
    constexpr std::uint64_t kPixels = std::uint64_t{kFieldSide} * kFieldSide;
    // Words by pixel; by sample at least u, v, h, pixel, triangle, two weights, tolerance and colour.
    const std::uint64_t min = kPixels * 8 + drawn.exact->samples * exact::SampleList::kBytesPerSample;
    EXPECT_GE(drawn.deviceMemory.count, min);
    EXPECT_LE(drawn.deviceMemory.count, min + drawn.exact->samples * 32 + drawn.exact->cells * 8);
}

// What is true of a picture through maps is asked of the same function.
TEST(ExactPass, TheTruthOfAFrameWithMapsIsThatOfAnExactOne) {
    plan::Quality maps = exactQuality();
    maps.shadows = plan::ShadowMode::Maps;
    const ExactFrame withMaps(7, maps);
    const ExactFrame exact(7);
    EXPECT_TRUE(withMaps.drawing().plan->sampleGridMaps.empty());
    const Raster<std::uint8_t> truth = litByIntegers(withMaps.drawing());
    EXPECT_EQ(truth.pixels, litByIntegers(exact.drawing()).pixels);
    EXPECT_GT(std::count(truth.pixels.begin(), truth.pixels.end(), 255), 1000);
    EXPECT_EQ(sampleSpace(withMaps.drawing()).maps, 1);
}

} // namespace
} // namespace gnomon::render
