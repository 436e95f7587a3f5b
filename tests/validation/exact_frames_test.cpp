// Frames in exact shadows against the plain integer oracle, against rays, and against themselves: with surfaces, with
// other threads, after other frames.
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shadow_triples.h"
#include "tests/validation/exact_stage.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <optional>
#include <set>

namespace gnomon::validation {
namespace {

using plan::ShadowMode;

const hierarchy::ModelFile& plant() {
    static const tests::BuiltFile model("plant", 20000);
    return model.file();
}

const hierarchy::ModelFile& statue() {
    static const tests::BuiltFile model("statue", 6000);
    return model.file();
}

const hierarchy::ModelFile& planes() {
    static const tests::BuiltFile model("planes", 20000);
    return model.file();
}

class ExactFrames : public testing::TestWithParam<const hierarchy::ModelFile& (*)()> {};

/// Triple `index` of a model, in exact shadows; sizes are odd, and seldom square.
tests::ShadowTriple exactTriple(const Box& bounds, std::uint64_t index) {
    tests::ShadowTriple triple = tests::shadowTriple(bounds, index, 96, 256);
    triple.view.width = 61 + static_cast<int>(index * 17 % 50);
    triple.view.height = 61 + static_cast<int>(index * 29 % 50);
    triple.quality = exactQuality();
    if (index % 3 == 1) triple.view.pointLight = tests::lampFor(bounds, triple.view, index / 3);
    if (index % 6 == 5) triple.quality.maxTriangles = 3000;
    return triple;
}

TEST_P(ExactFrames, AreTrueAtEveryPixel) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage(GetParam()());
    std::uint64_t dark = 0;
    std::uint64_t lit = 0;
    for (std::uint64_t i = 0; i < 24; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        const frame::PreparedFrame frame = stage.prepare(triple.view, triple.quality);
        if (!frame.isExact()) continue;
        const Shot shot = stage.judged(frame);
        ASSERT_TRUE(shot.exact);
        EXPECT_EQ(shot.wrong, 0U);
        dark += shot.exact->dark;
        lit += shot.exact->samples - shot.exact->dark;
    }
    EXPECT_GT(dark, 500U) << "hardly a shadow: this tests nothing";
    EXPECT_GT(lit, 1000U);
}

// Surfaces call for shading once more, by what was decided; threads share samples and casters out in any order.
TEST_P(ExactFrames, AreTheSameWithSurfacesAndWithAnyThreads) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage(GetParam()());
    for (std::uint64_t i = 16; i < 28; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        const frame::PreparedFrame frame = stage.prepare(triple.view, triple.quality);
        frame::FrameOptions withSurfaces;
        withSurfaces.wantsSurfaces = true;
        const Shot surfaced = stage.draw(frame, withSurfaces);
        for (const int threads : {1, 2}) {
            Shot plain;
            tbb::task_arena(threads).execute([&] { plain = stage.draw(frame); });
            EXPECT_TRUE(plain.picture.pixels == surfaced.picture.pixels) << threads;
            EXPECT_EQ(countsOf(plain), countsOf(surfaced)) << threads;
        }
    }
}

// Rays begin at the very samples, with the same tolerance, in light of any slant: what differs are Embree's floats, and
// integers side with exact shadows.
TEST_P(ExactFrames, DifferFromRaysByFloatsAlone) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage(GetParam()());
    std::size_t differing = 0;
    std::size_t dark = 0;
    for (std::uint64_t i = 0; i < 16; ++i) {
        SCOPED_TRACE(i);
        tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        if (i % 3 == 2) triple.view.towardsLight.y *= 0.01;
        const frame::PreparedFrame exact = stage.prepare(triple.view, triple.quality);
        if (!exact.isExact()) continue;
        const Shot decided = stage.judged(exact);
        triple.quality.shadows = ShadowMode::Rays;
        const Shot traced = stage.judged(stage.prepare(triple.view, triple.quality));
        std::size_t here = 0;
        for (std::size_t p = 0; p < decided.surfaces.pixels.size(); ++p) {
            const render::SurfaceSample& surface = decided.surfaces.pixels[p];
            here += isLit(surface) != isLit(traced.surfaces.pixels[p]) ? 1U : 0U;
            dark += surface.isLitSide() && !isLit(surface) ? 1U : 0U;
        }
        EXPECT_EQ(decided.wrong, 0U);
        EXPECT_EQ(traced.wrong, here);
        differing += here;
    }
    EXPECT_LE(differing, 2U);
    EXPECT_GT(dark, 1000U);
}

// Threads make trees and trace rays in any order; surfaces call for shading once more, by what was decided.
TEST_P(ExactFrames, AreTheSameByRaysWithAnyThreads) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    for (std::uint64_t i = 30; i < 36; ++i) {
        SCOPED_TRACE(i);
        std::vector<render::Picture> pictures;
        for (const int threads : {1, 2, 2})
            tbb::task_arena(threads).execute([&] {
                Stage stage(GetParam()());
                tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
                triple.quality.shadows = ShadowMode::Rays;
                frame::FrameOptions options;
                options.wantsSurfaces = pictures.size() == 2;
                pictures.push_back(stage.draw(stage.prepare(triple.view, triple.quality), options).picture);
            });
        EXPECT_TRUE(pictures[0].pixels == pictures[1].pixels);
        EXPECT_TRUE(pictures[0].pixels == pictures[2].pixels);
    }
}

// Cells say who is held against whom, and nothing of what comes of it.
TEST_P(ExactFrames, AreTheSameOverAnyLayoutOfCells) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage(GetParam()());
    std::set<std::uint64_t> tests;
    for (std::uint64_t i = 28; i < 36; ++i) {
        SCOPED_TRACE(i);
        tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        std::optional<Shot> usual;
        for (const auto& scheme : plan::kCellSchemes) {
            SCOPED_TRACE(scheme.word);
            triple.quality.cellScheme = scheme.value;
            const Shot shot = stage.draw(stage.prepare(triple.view, triple.quality));
            if (!usual) usual = shot;
            EXPECT_TRUE(shot.picture.pixels == usual->picture.pixels);
            ASSERT_EQ(shot.exact.has_value(), usual->exact.has_value());
            if (!shot.exact) continue;
            EXPECT_EQ(shot.exact->samples, usual->exact->samples);
            EXPECT_EQ(shot.exact->dark, usual->exact->dark);
            EXPECT_EQ(shot.exact->withinTolerance, usual->exact->withinTolerance);
            tests.insert(shot.exact->counts.sampleTests);
        }
    }
    EXPECT_GT(tests.size(), 16U) << "hardly a layout differs: this tests nothing";
}

INSTANTIATE_TEST_SUITE_P(Plant, ExactFrames, testing::Values(&plant));
INSTANTIATE_TEST_SUITE_P(Statue, ExactFrames, testing::Values(&statue));
INSTANTIATE_TEST_SUITE_P(Planes, ExactFrames, testing::Values(&planes));

} // namespace
} // namespace gnomon::validation
