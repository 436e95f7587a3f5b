// Orthographic views: the image against plain parallel lines, its shadows against rays and integers, and all that
// leaves something out against what leaves out nothing.
#include "core/random.h"
#include "frame/renderer.h"
#include "frame/scene_facts.h"
#include "lod/error_rule.h"
#include "plan/distant_view.h"
#include "render/software_backend.h"
#include "render/view/image_projection.h"
#include "tests/support/made_model.h"
#include "tests/support/sanitizers.h"
#include "tests/support/shadow_triples.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::validation {
namespace {

constexpr int kParallelSide = 192;

/// A model with its renderer.
class ParallelStage {
public:
    ParallelStage(const std::string& kind, std::uint64_t triangles) : model_(kind, triangles) {}

    const Box& bounds() const { return model_.file().summary().bounds; }

    render::Backend& backend() { return *backend_; }

    frame::Renderer& renderer() { return renderer_; }

    frame::Frame render(const tests::ShadowTriple& triple) { return renderer_.render(triple.view, triple.quality, {}); }

    render::Picture picture(const tests::ShadowTriple& triple) {
        render(triple);
        return backend_->picture();
    }

private:
    tests::BuiltFile model_;
    std::unique_ptr<render::Backend> backend_ = render::makeSoftwareBackend();
    frame::Renderer renderer_{model_.file(), *backend_, {}};
};

/// Triple `index`, seen by parallel lines.
tests::ShadowTriple parallelTriple(const Box& bounds, std::uint64_t index) {
    tests::ShadowTriple triple = tests::shadowTriple(bounds, index, kParallelSide, 492);
    triple.view.camera.projection = Projection::Orthographic;
    return triple;
}

/// A triangle with corners in pixels and depths, by the three sides of each pixel's middle.
void drawPlainly(const std::array<glm::dvec3, 3>& p, render::FloatPicture& depths) {
    const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (area == 0) return;
    const glm::dvec3 low = glm::min(p[0], glm::min(p[1], p[2]));
    const glm::dvec3 high = glm::max(p[0], glm::max(p[1], p[2]));
    for (int y = std::max(0, static_cast<int>(low.y)); y <= std::min(depths.height - 1.0, high.y); ++y)
        for (int x = std::max(0, static_cast<int>(low.x)); x <= std::min(depths.width - 1.0, high.x); ++x) {
            const glm::dvec2 at(x + 0.5, y + 0.5);
            const auto side = [&](const glm::dvec3& a, const glm::dvec3& b) {
                return ((b.x - a.x) * (at.y - a.y) - (b.y - a.y) * (at.x - a.x)) / area;
            };
            const double w0 = side(p[1], p[2]);
            const double w1 = side(p[2], p[0]);
            const double w2 = side(p[0], p[1]);
            if (std::min({w0, w1, w2}) < 0) continue;
            float& depth = depths.at(x, y);
            depth = std::min(depth, static_cast<float>(w0 * p[0].z + w1 * p[1].z + w2 * p[2].z));
        }
}

/// View depths by lines that run through the middles of pixels, along the view and apart by what a pixel of the asked
/// camera is wide: each triangle of the cut by itself, in doubles. Infinite where none is met.
render::FloatPicture plainDepths(const frame::Renderer& renderer, const frame::Frame& frame, const plan::View& asked) {
    const CameraBasis basis = cameraBasis(asked.camera);
    const double perUnit = asked.height / (2 * halfHeightAtTarget(asked.camera));
    const render::DrawInputs drawing = renderer.drawing(frame, {});
    render::FloatPicture depths(asked.width, asked.height, std::numeric_limits<float>::infinity());
    const auto inPixels = [&](const hierarchy::GridPoint& cell) {
        const glm::dvec3 p = toCamera(basis, drawing.grid.origin + drawing.grid.local(cell) - asked.camera.eye);
        return glm::dvec3(0.5 * asked.width + p.x * perUnit, 0.5 * asked.height - p.y * perUnit, p.z);
    };
    const auto drawCluster = [&](const hierarchy::Page& page, const hierarchy::Cluster& cluster) {
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            std::array<glm::dvec3, 3> corners{};
            for (std::size_t k = 0; k < 3; ++k) {
                const auto vertex = page.triangles[cluster.firstTriangle + t][k];
                corners.at(k) = inPixels(page.vertices[cluster.firstVertex + vertex].position);
            }
            drawPlainly(corners, depths);
        }
    };
    for (const lod::ClusterRange& range : drawing.image->ranges) {
        const hierarchy::Page& page = drawing.pages(range.page);
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            drawCluster(page, page.clusters[c]);
    }
    return depths;
}

TEST(Orthographic, AnImageIsWhatParallelLinesMeet) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    ParallelStage stage("plant", 20000);
    const auto size = static_cast<float>(glm::length(stage.bounds().extent()));
    double covered = 0;
    for (std::uint64_t i = 0; i < 12; ++i) {
        const tests::ShadowTriple triple = parallelTriple(stage.bounds(), i);
        const frame::Frame frame = stage.render(triple);
        const render::FloatPicture found = stage.backend().viewDepth();
        const render::FloatPicture wanted = plainDepths(stage.renderer(), frame, triple.view);
        std::size_t unlike = 0;
        for (std::size_t p = 0; p < found.pixels.size(); ++p) {
            const float a = found.pixels[p];
            const float b = wanted.pixels[p];
            covered += std::isfinite(a) ? 1 : 0;
            unlike += std::isfinite(a) != std::isfinite(b) || std::abs(a - b) > 1e-4F * size ? 1U : 0U;
        }
        // A line through an edge may be snapped to either side of it.
        EXPECT_LE(unlike, found.pixels.size() / 100) << i;
    }
    EXPECT_GT(covered, 0.3 * 12 * kParallelSide * kParallelSide);
}

TEST(Orthographic, WhereTheEyeStandsAlongTheViewMakesNoDifference) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    ParallelStage stage("plant", 20000);
    for (std::uint64_t i = 0; i < 6; ++i) {
        tests::ShadowTriple triple = parallelTriple(stage.bounds(), i);
        triple.quality.shadows = plan::ShadowMode::Exact;
        const render::Picture picture = stage.picture(triple);
        const render::FloatPicture depth = stage.backend().viewDepth();
        Camera& camera = triple.view.camera;
        const glm::dvec3 back = -3.0 * (camera.target - camera.eye);
        camera.eye += back;
        camera.target += back;
        EXPECT_LE(render::difference(stage.picture(triple), picture).changedFraction, 1e-3) << i;
        const render::FloatPicture moved = stage.backend().viewDepth();
        const double by = glm::length(back);
        for (std::size_t p = 0; p < depth.pixels.size(); p += 17) {
            if (!std::isfinite(depth.pixels[p]) || !std::isfinite(moved.pixels[p])) continue;
            EXPECT_NEAR(moved.pixels[p] - depth.pixels[p], by, 0.05 * by) << i;
        }
    }
}

TEST(Orthographic, ALensFindsThePointsThatItsImageStores) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Random random(6);
    for (int i = 0; i < 200; ++i) {
        render::ImageProjection projection;
        projection.half = {random.uniform(0.1, 3), random.uniform(0.1, 3)};
        projection.depth = {i % 2 == 0, {random.uniform(0.5, 2), random.uniform(3, 9)}, random.uniform(0, 5)};
        const glm::dvec2 at(random.uniform(-1, 1), random.uniform(-1, 1));
        const double depth = random.uniform(2, 3);
        const glm::dvec2 moved(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01));
        const glm::dvec4 clip = projection.clipFromCamera(moved) * glm::dvec4(projection.visiblePoint(at, depth), 1);
        EXPECT_LT(glm::length(glm::dvec2(clip) / clip.w - at - moved), 1e-12);
        const auto stored = static_cast<float>(clip.z / clip.w);
        EXPECT_NEAR(projection.depth.fromEye(stored), depth, 1e-5);
        EXPECT_NEAR(projection.depth.asked(stored), depth - projection.depth.eyeMovedBack, 1e-5);
        EXPECT_TRUE(std::isinf(projection.depth.asked(0)));
    }
}

// No more error in pixels than was asked for at any depth, and hardly less.
TEST(Orthographic, AnErrorHasAsManyPixelsAtEveryDepth) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    Random random(5);
    const Box bounds{{-3, -1, -2}, {4, 1, 2}};
    for (int i = 0; i < 200; ++i) {
        const tests::ShadowTriple triple = parallelTriple(bounds, static_cast<std::uint64_t>(i));
        const plan::View view = plan::distantView(triple.view, bounds);
        EXPECT_EQ(plan::distantView(view, bounds).camera.eye, view.camera.eye);
        EXPECT_NEAR(halfHeightAtTarget(view.camera), halfHeightAtTarget(triple.view.camera), 1e-9);
        const lod::ErrorRule rule(frame::detailView(view, view.camera.eye));
        const CameraBasis basis = cameraBasis(view.camera);
        const double half = halfHeightAtTarget(triple.view.camera);
        const glm::dvec3 aside(random.uniform(-half, half), random.uniform(-half, half), 0);
        const double middle = glm::dot(basis.view, bounds.center() - triple.view.camera.eye);
        const double reach = 0.5 * glm::length(bounds.extent());
        const glm::dvec3 point =
            triple.view.camera.eye + toWorld(basis, aside + glm::dvec3(0, 0, middle + random.uniform(-reach, reach)));
        const double error = std::exp2(random.uniform(-12, 0));
        const double pixels = error * triple.view.height / (2 * half);
        const double found = rule.viewPixels({point, 0}, error);
        EXPECT_GE(found, pixels * (1 - 1e-9));
        EXPECT_LE(found, pixels * 1.009);
    }
}

struct ParallelTruth {
    std::uint64_t judged = 0;
    std::uint64_t unexplained = 0;
    std::uint64_t wrong = 0;
};

/// `view` by lines of sight that part by `fovYRadians` and show as much at the target.
void seeFrom(plan::View& view, double fovYRadians) {
    Camera& camera = view.camera;
    const double distance = halfHeightAtTarget(camera) / std::tan(fovYRadians / 2);
    camera.eye = camera.target - cameraBasis(camera).view * distance;
    camera.fovYRadians = fovYRadians;
    camera.projection = Projection::Perspective;
}

/// Over 20 views, each changed by `change`.
template <class Change>
ParallelTruth truthOver(ParallelStage& stage, const Change& change) {
    ValidationOptions options;
    options.groundTruth = GroundTruth::SameDetail;
    ParallelTruth sum;
    for (std::uint64_t i = 0; i < 20; ++i) {
        tests::ShadowTriple triple = tests::withDefaults(parallelTriple(stage.bounds(), i));
        change(triple.view);
        const frame::Frame frame = stage.render(triple);
        const FrameValidation proof = validate(stage.renderer(), frame, options);
        if (!proof.truth) continue;
        sum.judged += proof.truth->judgedPixels;
        sum.unexplained += proof.truth->unexplainedPixels;
        sum.wrong += proof.truth->shadows.wrongPixels;
    }
    return sum;
}

TEST(Orthographic, MapsAreAsTrueAsThoseOfPerspectiveViews) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    for (const char* kind : {"plant", "statue"}) {
        SCOPED_TRACE(kind);
        ParallelStage stage(kind, 20000);
        const ParallelTruth parallel = truthOver(stage, [](plan::View&) {});
        const ParallelTruth wide =
            truthOver(stage, [](plan::View& view) { view.camera.projection = Projection::Perspective; });
        const ParallelTruth narrow = truthOver(stage, [](plan::View& view) { seeFrom(view, 0.02); });
        const auto share = [](std::uint64_t count, const ParallelTruth& of) {
            return static_cast<double>(count) / static_cast<double>(of.judged);
        };
        EXPECT_GT(parallel.judged, 100000U);
        EXPECT_LE(share(parallel.unexplained, parallel), 5e-4);
        EXPECT_LE(share(parallel.wrong, parallel), 1.25 * share(wide.wrong, wide));
        // From far away a narrow angle sees the same edges, and as many of them: that is what the rest of it is.
        EXPECT_LE(share(parallel.wrong, parallel), 1.1 * share(narrow.wrong, narrow));
        EXPECT_GE(share(parallel.wrong, parallel), share(narrow.wrong, narrow) / 1.25);
    }
}

TEST(Orthographic, PromisesAreKeptWhateverTheScheme) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    ParallelStage stage("plant", 20000);
    ValidationOptions options;
    options.measuresAliasing = true;
    int measured = 0;
    for (std::uint64_t i = 0; i < 40; ++i) {
        tests::ShadowTriple triple = parallelTriple(stage.bounds(), i);
        if (i % 5 == 4) triple.quality.far = glm::length(triple.view.camera.target - triple.view.camera.eye);
        const frame::Frame frame = stage.render(triple);
        for (const plan::ShadowPass& pass : frame.plan.passes)
            EXPECT_EQ(pass.map.warped.kappa, 0) << i;
        EXPECT_FALSE(frame.plan.hasFaces);
        const FrameValidation proof = validate(stage.renderer(), frame, options);
        if (!proof.aliasing || proof.aliasing->pixelsMeasured == 0) continue;
        ++measured;
        EXPECT_LE(proof.aliasing->overBound, 1.001) << i << ": " << tests::describe(triple);
    }
    EXPECT_GE(measured, 30);
}

TEST(Orthographic, WhatIsLeftOutIsNotSeen) {
    GNOMON_TOO_LONG_FOR_SANITIZERS();
    ParallelStage stage("plant", 20000);
    for (std::uint64_t i = 0; i < 16; ++i) {
        SCOPED_TRACE(i);
        tests::ShadowTriple triple = parallelTriple(stage.bounds(), i);
        triple.quality.stabilize = false;
        triple.quality.cullCasters = plan::CasterCulling::Off;
        triple.quality.occlusion = plan::Choice::Off;
        const render::Picture whole = stage.picture(triple);
        triple.quality.occlusion = plan::Choice::On;
        for (const auto culling : {plan::CasterCulling::On, plan::CasterCulling::Receivers}) {
            triple.quality.cullCasters = culling;
            EXPECT_TRUE(stage.picture(triple).pixels == whole.pixels);
        }
    }
}

} // namespace
} // namespace gnomon::validation
