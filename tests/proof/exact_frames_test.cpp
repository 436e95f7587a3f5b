// Frames in exact shadows against the plain integer oracle, against rays, and against themselves: with surfaces, with
// other threads, after other frames.
#include "executor/exact_pass.h"
#include "executor/software_executor.h"
#include "frame/made_model.h"
#include "frame/shadow_triples.h"
#include "proof/frame_proof.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <array>

namespace gnomon::proof {
namespace {

using plan::ShadowMode;

/// What a frame came to.
struct Shot {
    std::optional<exact::ExactStatistics> exact;
    executor::Picture picture;
    executor::Raster<executor::SurfaceSample> surfaces;
    std::size_t samples = 0;
    std::size_t wrong = 0; // pixels lit or dark against the integers
};

/// All that its statistics count; nothing of a frame without.
std::vector<std::uint64_t> countsOf(const Shot& shot) {
    if (!shot.exact) return {};
    const exact::ExactStatistics& s = *shot.exact;
    return {
        s.samples,
        s.cells,
        s.dark,
        s.darkWithoutTolerance,
        s.touching,
        s.cast.clustersTested,
        s.cast.clustersKept,
        s.cast.triangles,
        s.cast.trianglesCast,
        s.cast.sampleTests,
        s.cast.exactDecisions};
}

bool isLit(const executor::SurfaceSample& surface) {
    return surface.isLitSide() && surface.litFraction() >= 0.5F;
}

/// A model with a renderer over the software executor.
class Stage {
public:
    explicit Stage(const hierarchy::ModelFile& file) : file_(&file), renderer_(file, *executor_, {}) {}

    const Box& bounds() const { return file_->summary().bounds; }

    frame::PreparedFrame prepare(const plan::View& view, const plan::Quality& quality) {
        return renderer_.prepare(view, quality, frame::Waiting::UntilComplete, nullptr);
    }

    Shot draw(const frame::PreparedFrame& frame, const frame::FrameOptions& options = {}) {
        Shot shot;
        shot.exact = renderer_.draw(frame, options).exact;
        shot.picture = executor_->picture();
        if (options.wantsSurfaces) shot.surfaces = executor_->surfaces();
        return shot;
    }

    /// Draws with surfaces, and counts what the plain loops over all casters of the frame say otherwise.
    Shot judged(const frame::PreparedFrame& frame, frame::FrameOptions options = {}) {
        options.wantsSurfaces = true;
        Shot shot = draw(frame, options);
        executor::FrameDrawing drawing = renderer_.drawing(frame, options);
        drawing.exactCasters = &frame.cut.lists.at(1);
        const executor::Raster<std::uint8_t> truth = executor::litByIntegers(drawing);
        EXPECT_EQ(truth.pixels.size(), shot.surfaces.pixels.size());
        for (std::size_t i = 0; i < truth.pixels.size(); ++i)
            shot.wrong += isLit(shot.surfaces.pixels[i]) != (truth.pixels[i] != 0) ? 1U : 0U;
        return shot;
    }

    frame::Renderer& renderer() { return renderer_; }

private:
    const hierarchy::ModelFile* file_;
    std::unique_ptr<executor::Executor> executor_ = executor::makeSoftwareExecutor();
    frame::Renderer renderer_;
};

plan::Quality exactQuality() {
    plan::Quality quality;
    quality.shadows = ShadowMode::Exact;
    return quality;
}

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
    if (index % 6 == 5) triple.quality.maxTriangles = 3000;
    return triple;
}

TEST_P(ExactFrames, AreTrueAtEveryPixel) {
    Stage stage(GetParam()());
    std::uint64_t dark = 0;
    std::uint64_t lit = 0;
    for (std::uint64_t i = 0; i < 16; ++i) {
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

TEST_P(ExactFrames, AreTheSameWithSurfacesAndWithout) {
    Stage stage(GetParam()());
    for (std::uint64_t i = 16; i < 28; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        const frame::PreparedFrame frame = stage.prepare(triple.view, triple.quality);
        frame::FrameOptions withSurfaces;
        withSurfaces.wantsSurfaces = true;
        const Shot plain = stage.draw(frame);
        const Shot surfaced = stage.draw(frame, withSurfaces);
        EXPECT_TRUE(plain.picture.pixels == surfaced.picture.pixels);
        EXPECT_EQ(countsOf(plain), countsOf(surfaced));
    }
}

TEST_P(ExactFrames, AreTheSameWithOneThreadAndWithTwo) {
    Stage stage(GetParam()());
    for (std::uint64_t i = 28; i < 40; ++i) {
        SCOPED_TRACE(i);
        const tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        const frame::PreparedFrame frame = stage.prepare(triple.view, triple.quality);
        std::array<Shot, 2> shots;
        for (int threads : {1, 2})
            tbb::task_arena(threads).execute(
                [&] { shots.at(static_cast<std::size_t>(threads - 1)) = stage.draw(frame); });
        EXPECT_TRUE(shots[0].picture.pixels == shots[1].picture.pixels);
        EXPECT_EQ(countsOf(shots[0]), countsOf(shots[1]));
    }
}

// Rays begin a quarter of a pixel off their surface: in light that grazes it they pass over what casts shadows there.
TEST_P(ExactFrames, DifferFromRaysWhereIntegersSideWithThem) {
    constexpr double kSteep = 0.3;
    Stage stage(GetParam()());
    std::size_t differing = 0;
    std::size_t inSteepLight = 0;
    std::size_t pixels = 0;
    for (std::uint64_t i = 0; i < 12; ++i) {
        SCOPED_TRACE(i);
        tests::ShadowTriple triple = exactTriple(stage.bounds(), i);
        const glm::dvec3 light = glm::normalize(triple.view.towardsLight);
        const Shot decided = stage.judged(stage.prepare(triple.view, triple.quality));
        triple.quality.shadows = ShadowMode::Rays;
        const Shot traced = stage.judged(stage.prepare(triple.view, triple.quality));
        std::size_t here = 0;
        for (std::size_t p = 0; p < decided.surfaces.pixels.size(); ++p) {
            const executor::SurfaceSample& surface = decided.surfaces.pixels[p];
            if (isLit(surface) == isLit(traced.surfaces.pixels[p])) continue;
            ++here;
            inSteepLight += glm::dot(glm::dvec3(surface.normal), light) > kSteep ? 1U : 0U;
        }
        EXPECT_EQ(decided.wrong, 0U);
        EXPECT_EQ(traced.wrong, here);
        differing += here;
        pixels += decided.surfaces.pixels.size();
    }
    EXPECT_GT(differing, 0U) << "rays are as good: this tests nothing";
    EXPECT_LE(inSteepLight * 400, pixels) << inSteepLight << " of " << differing << " of " << pixels;
}

INSTANTIATE_TEST_SUITE_P(Plant, ExactFrames, testing::Values(&plant));
INSTANTIATE_TEST_SUITE_P(Statue, ExactFrames, testing::Values(&statue));
INSTANTIATE_TEST_SUITE_P(Planes, ExactFrames, testing::Values(&planes));

} // namespace
} // namespace gnomon::proof
