// Shadow maps against rays and against their own promise, on models that were made and built on the spot.
#include "frame/renderer.h"
#include "gl/shader_library.h"
#include "render/gl/gl_backend.h"
#include "render/software_backend.h"
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shadow_triples.h"
#include "tests/support/tested_platform.h"
#include "tests/support/tiny_model.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include <unistd.h>

namespace gnomon::validation {
namespace {

using tests::ShadowTriple;

constexpr int kSide = 256;
constexpr int kTexels = 656; // to the image as the default budget is to the default image
constexpr std::uint64_t kTriples = 30;
constexpr double kFloatTolerance = 1e-3;

/// A model with its renderer.
class Stage {
public:
    Stage(const std::string& kind, std::uint64_t triangles, std::unique_ptr<render::Backend> backend)
        : model_(kind, triangles), backend_(std::move(backend)), renderer_(model_.file(), *backend_, {}) {}

    const Box& bounds() const { return model_.file().summary().bounds; }

    render::Backend& backend() { return *backend_; }

    frame::Frame render(const ShadowTriple& triple) { return renderer_.render(triple.view, triple.quality, {}); }

    FrameValidation validationOf(const frame::Frame& frame, const ValidationOptions& options) {
        return validate(renderer_, frame, options);
    }

private:
    tests::BuiltFile model_;
    std::unique_ptr<render::Backend> backend_;
    frame::Renderer renderer_;
};

Stage softwareStage(const std::string& kind, std::uint64_t triangles) {
    return {kind, triangles, render::makeSoftwareBackend()};
}

/// Sums over triples with the default settings.
struct Judged {
    std::uint64_t pixels = 0;
    std::uint64_t unexplained = 0;
    std::uint64_t wrong = 0;
};

Judged judge(Stage& stage) {
    ValidationOptions options;
    options.groundTruth = GroundTruth::SameDetail;
    Judged sum;
    for (std::uint64_t i = 0; i < kTriples; ++i) {
        const ShadowTriple triple = withDefaults(tests::shadowTriple(stage.bounds(), i, kSide, kTexels));
        const FrameValidation proof = stage.validationOf(stage.render(triple), options);
        if (!proof.truth) continue;
        sum.pixels += proof.truth->judgedPixels;
        sum.unexplained += proof.truth->unexplainedPixels;
        sum.wrong += proof.truth->shadows.wrongPixels;
    }
    return sum;
}

void expectBoundKept(Stage& stage, std::uint64_t triples = kTriples, std::optional<shadow::WarpRule> warp = {}) {
    ValidationOptions options;
    options.measuresAliasing = true;
    int measured = 0;
    for (std::uint64_t i = 0; i < triples; ++i) {
        ShadowTriple triple = tests::shadowTriple(stage.bounds(), i, kSide, kTexels);
        if (warp) {
            triple.quality.warp = {};
            triple.quality.warp.rule = *warp;
            triple.quality.stabilize = false;
        }
        const frame::Frame frame = stage.render(triple);
        const std::optional<MeasuredAliasing> aliasing = stage.validationOf(frame, options).aliasing;
        if (!aliasing || aliasing->pixelsMeasured == 0) continue;
        ++measured;
        EXPECT_LE(aliasing->overBound, 1 + kFloatTolerance) << i << ": " << tests::describe(triple);
        EXPECT_LE(aliasing->x, frame.plan.aliasingBound.x * (1 + kFloatTolerance)) << i;
        EXPECT_LE(aliasing->z, frame.plan.aliasingBound.z * (1 + kFloatTolerance)) << i;
    }
    EXPECT_GE(measured * 3, static_cast<int>(triples) * 2);
}

TEST(MeasuredAliasing, IsNeverAboveThePromiseOnAPlant) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("plant", 20000);
    expectBoundKept(stage);
}

TEST(MeasuredAliasing, IsNeverAboveThePromiseOfLogarithmicRows) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("plant", 20000);
    expectBoundKept(stage, 16, shadow::WarpRule::Log);
}

TEST(MeasuredAliasing, IsNeverAboveThePromiseOnAStatue) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("statue", 10000);
    expectBoundKept(stage);
}

// Triples 83 and 155 broke it on the plant: a TSM so steep that floats could not hold its derivatives.
TEST(SlowMeasuredAliasing, IsNeverAboveThePromiseOverManyTriples) {
    Stage plant = softwareStage("plant", 300000);
    expectBoundKept(plant, 300);
    Stage statue = softwareStage("statue", 10000);
    expectBoundKept(statue, 300);
}

/// A ground in a file of its own, all but flat: without any hill no caster could reach it and no map would be drawn.
class Ground {
public:
    Ground() {
        tests::TinyModelOptions options;
        options.gridExponent = 6;
        options.height = 0.01;
        tests::writeModel(tests::makeTinyModel(options), path_);
        file_ = std::make_unique<hierarchy::ModelFile>(path_);
    }

    ~Ground() { std::filesystem::remove(path_); }

    Ground(const Ground&) = delete;
    Ground& operator=(const Ground&) = delete;
    Ground(Ground&&) = delete;
    Ground& operator=(Ground&&) = delete;

    const hierarchy::ModelFile& file() const { return *file_; }

private:
    std::string path_ =
        (std::filesystem::temp_directory_path() / ("gnomon_ground_" + std::to_string(::getpid()) + ".gnm")).string();
    std::unique_ptr<hierarchy::ModelFile> file_;
};

// The promise is a maximum over the whole frustum, of which a picture shows one surface; a ground that fills the
// screen from near to far, lit from above, shows the worst of it.
TEST(MeasuredAliasing, OnAGroundThatFillsTheScreenComesNearThePromise) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const Ground ground;
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    frame::Renderer renderer(ground.file(), *backend, {});
    plan::View view;
    view.width = view.height = 128;
    const Box& bounds = ground.file().summary().bounds;
    const glm::dvec3 center = bounds.center();
    view.camera.eye = center + glm::dvec3(0, 2, 20);
    view.camera.target = center + glm::dvec3(0, 0, 16);
    view.camera.fovYRadians = 0.7;
    view.towardsLight = {0.05, 1, 0.02};
    ValidationOptions options;
    options.measuresAliasing = true;
    for (const shadow::WarpRule rule :
         {shadow::WarpRule::None, shadow::WarpRule::Lspsm, shadow::WarpRule::Minimax, shadow::WarpRule::Auto})
        for (const int slices : {1, 2, 4}) {
            plan::Quality quality;
            quality.warp.rule = rule;
            quality.zPartitions = slices;
            renderer.render(view, quality, {});
            const render::FloatPicture depth = backend->viewDepth();
            const auto [nearest, farthest] = std::minmax_element(depth.pixels.begin(), depth.pixels.end());
            ASSERT_TRUE(std::isfinite(*farthest)) << "the ground fills the screen";
            quality.near = static_cast<double>(*nearest) * 0.999;
            quality.far = static_cast<double>(*farthest) * 1.001;
            const FrameValidation proof = validate(renderer, renderer.render(view, quality, {}), options);
            ASSERT_TRUE(proof.aliasing);
            EXPECT_EQ(proof.aliasing->pixelsWithoutBound, 0U);
            EXPECT_GE(proof.aliasing->overBound, 0.8) << shadow::name(quality.warp.rule) << " " << slices;
            EXPECT_LE(proof.aliasing->overBound, 1 + kFloatTolerance)
                << shadow::name(quality.warp.rule) << " " << slices;
        }
}

TEST(MeasuredAliasing, IsTheSameThroughOpenGl) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    const tests::BuiltFile model("statue", 5000);
    ValidationOptions options;
    options.measuresAliasing = true;
    std::array<std::unique_ptr<render::Backend>, 2> backends = {
        render::makeSoftwareBackend(), render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(64))};
    for (std::uint64_t i = 0; i < 6; ++i) {
        const ShadowTriple triple = tests::shadowTriple(model.file().summary().bounds, i, 128, 256);
        std::array<double, 2> measured{};
        for (std::size_t e = 0; e < 2; ++e) {
            frame::Renderer renderer(model.file(), *backends[e], {});
            frame::Frame frame = renderer.render(triple.view, triple.quality, {});
            EXPECT_FALSE(frame.row.measuredAliasing) << "nothing is measured that was not asked for";
            setAccuracy(validate(renderer, frame, options), frame.row);
            measured[e] = frame.row.measuredAliasing.value_or(0);
        }
        EXPECT_NEAR(measured[0], measured[1], 0.02 * measured[1]) << tests::describe(triple);
    }
}

// Surfaces before and behind a given range lie on no map that ends with it: two thirds of what is seen there was wrong.
TEST(GivenRange, LeavesTheSurfacesOutsideItTheirShadows) {
    Stage stage = softwareStage("plant", 20000);
    Stage throughGl = {"plant", 20000, render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(64))};
    ValidationOptions options;
    options.groundTruth = GroundTruth::SameDetail;
    std::array<std::uint64_t, 3> wrong{};
    for (std::uint64_t i = 0; i < 6; ++i) {
        ShadowTriple triple = withDefaults(tests::shadowTriple(stage.bounds(), i, 128, 1024));
        const plan::FramePlan plan = stage.render(triple).plan;
        const double middle = std::sqrt(plan.near * plan.far);
        for (std::size_t given = 0; given < 3; ++given) {
            triple.quality.near = given == 1 ? std::optional(middle) : std::nullopt;
            triple.quality.far = given == 2 ? std::optional(middle) : std::nullopt;
            const FrameValidation proof = stage.validationOf(stage.render(triple), options);
            if (!proof.truth) continue;
            wrong[given] += proof.truth->shadows.wrongPixels;
            throughGl.render(triple);
            const double changed =
                render::difference(stage.backend().picture(), throughGl.backend().picture()).changedFraction;
            EXPECT_LE(changed, 0.02) << i << ", " << given;
        }
    }
    EXPECT_LE(wrong[1], 3 * wrong[0]);
    EXPECT_LE(wrong[2], 3 * wrong[0]);
}

// What rays light is what no scene object stands before: the same question asked of the maps at a resolution that
// leaves them nothing to be wrong about.
TEST(RayTracedShadows, AreThoseOfVeryFineMaps) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("statue", 5000);
    double fromRays = 0;
    double fromNone = 0;
    for (std::uint64_t i = 0; i < 8; ++i) {
        ShadowTriple triple = withDefaults(tests::shadowTriple(stage.bounds(), i, 128, 4096));
        stage.render(triple);
        const render::Picture maps = stage.backend().picture();
        triple.quality.shadows = plan::ShadowMode::Rays;
        const frame::Frame frame = stage.render(triple);
        EXPECT_TRUE(frame.plan.passes.empty());
        fromRays += render::difference(stage.backend().picture(), maps).mean;
        triple.quality.shadows = plan::ShadowMode::Off;
        stage.render(triple);
        fromNone += render::difference(stage.backend().picture(), maps).mean;
    }
    EXPECT_LE(fromRays, 0.2 * fromNone);
}

TEST(RayTracedShadows, AreTheSameThroughOpenGl) {
    const tests::BuiltFile model("plant", 20000);
    ShadowTriple triple = withDefaults(tests::shadowTriple(model.file().summary().bounds, 3, 128, 256));
    triple.quality.shadows = plan::ShadowMode::Rays;
    std::array<render::Picture, 2> pictures;
    std::array<std::unique_ptr<render::Backend>, 2> backends = {
        render::makeSoftwareBackend(), render::makeGlBackend(gl::testedPlatform(), gl::ShaderLibrary(), mebibytes(64))};
    for (std::size_t e = 0; e < 2; ++e) {
        frame::Renderer(model.file(), *backends[e], {}).render(triple.view, triple.quality, {});
        pictures[e] = backends[e]->picture();
    }
    EXPECT_LE(render::difference(pictures[0], pictures[1]).changedFraction, 0.01);
}

TEST(ShadowTruth, LeavesTheFrameAsItWasDrawn) {
    Stage stage = softwareStage("statue", 5000);
    const ShadowTriple triple = withDefaults(tests::shadowTriple(stage.bounds(), 5, 128, 256));
    stage.render(triple);
    const render::Picture plain = stage.backend().picture();
    for (const GroundTruth groundTruth : {GroundTruth::SameDetail, GroundTruth::FullDetail}) {
        ValidationOptions options;
        options.groundTruth = groundTruth;
        options.comparesWithFinest = true;
        frame::Frame frame = stage.render(triple);
        setAccuracy(stage.validationOf(frame, options), frame.row);
        EXPECT_EQ(stage.backend().picture().pixels, plain.pixels);
        ASSERT_TRUE(frame.row.imageDifference);
        EXPECT_LT(*frame.row.imageDifference, 0.05);
        ASSERT_TRUE(frame.row.wrongShadowFraction);
        EXPECT_LT(*frame.row.wrongShadowFraction, 0.1);
    }
}

TEST(ShadowTruth, DefaultMapsAreWrongOnlyWithinATexelOfAnEdgeAmongPlanes) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("planes", 20000);
    const Judged judged = judge(stage);
    EXPECT_GT(judged.wrong, 0U) << "maps are not rays";
    EXPECT_LE(static_cast<double>(judged.unexplained), 5e-4 * static_cast<double>(judged.pixels)) << judged.pixels;
}

TEST(ShadowTruth, DefaultMapsAreWrongOnlyWithinATexelOfAnEdgeOnAStatue) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Stage stage = softwareStage("statue", 10000);
    const Judged judged = judge(stage);
    EXPECT_GT(judged.wrong, 0U);
    EXPECT_LE(static_cast<double>(judged.unexplained), 5e-4 * static_cast<double>(judged.pixels)) << judged.pixels;
}

} // namespace
} // namespace gnomon::validation
