// Shadows that are known by hand, from maps and from rays; and what is too fine for a map, counted apart.
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "validation/frame_validation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace gnomon::validation {
namespace {

/// What a point (x, z) of the ground is told by hand.
using ByHand = std::function<bool(double x, double z)>;

/// Whether `isShaded` says the same within `margin` of (x, z).
bool isSure(const ByHand& isShaded, double x, double z, double margin) {
    for (const double dx : {-margin, 0.0, margin})
        for (const double dz : {-margin, 0.0, margin})
            if (isShaded(x + dx, z + dz) != isShaded(x, z)) return false;
    return true;
}

/// Checks the shadows on the ground y = 0 against `isShaded`, from maps of one slice and of four, and from rays. Points
/// nearer than `margin` to where the answer changes are not asked.
void expectByHand(
    frame::DrawnModel& model, const plan::View& view, const glm::dvec3& origin, double margin, const ByHand& isShaded) {
    for (const int slices : {1, 4, 0}) {
        SCOPED_TRACE(slices);
        plan::Quality quality;
        quality.shadowTexelsWidth = quality.shadowTexelsHeight = 1024;
        quality.zPartitions = std::max(1, slices);
        if (slices == 0) quality.shadows = plan::ShadowMode::Rays;
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        const frame::Frame frame = model.draw(view, quality, options);
        const render::Raster<render::SurfaceSample> surfaces = model.backend().surfaces();
        const glm::dmat4 drawFromCamera = glm::inverse(frame.space.cameraFromDraw);
        const glm::dvec3 eyeInDraw(drawFromCamera[3]);
        std::uint64_t dark = 0;
        std::uint64_t wrong = 0;
        for (const render::SurfaceSample& surface : surfaces.pixels) {
            if (!surface.isLitSide() || surface.normal.y < 0.99F) continue;
            const glm::dvec3 p = glm::dvec3(surface.position) - eyeInDraw + (view.camera.eye - origin);
            if (std::abs(p.y) > 0.05 || !isSure(isShaded, p.x, p.z, margin)) continue;
            const bool expected = isShaded(p.x, p.z);
            const bool isDark = surface.litFraction() < 0.5F;
            dark += isDark ? 1 : 0;
            wrong += isDark != expected ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0U);
        EXPECT_GT(dark, 50U);
    }
}

/// The shadow on the ground of the box [-1, 1] x [0, 2] x [-1, 1] under the light (1, 1, 0): a height h throws it h to
/// -x. The box's own foot counts as shaded.
bool crateShadow(double x, double z) {
    return std::abs(z) < 1 && x > -3 && x < 1;
}

constexpr double kMargin = 0.2; // several texels of the coarser of the two maps

TEST(ShadowsByHand, OfABoxOnAPlane) {
    frame::DrawnModel model(frame::crateOnGround().model());
    expectByHand(model, frame::overGround(), glm::dvec3(0), kMargin, crateShadow);
}

TEST(ShadowsByHand, OfABoxFarFromTheOrigin) {
    const glm::dvec3 origin(1e7, 2e6, -1e7);
    frame::DrawnModel model(frame::crateOnGround(origin).model());
    expectByHand(model, frame::overGround(origin), origin, kMargin, crateShadow);
}

TEST(ShadowsByHand, OfABoxBehindTheViewer) {
    // The light comes from behind the viewer at 45 degrees: what is 30 up and 30 back lands where the view looks.
    tests::SceneMesh scene;
    scene.addGround(128, 16);
    scene.addBox({-1, 30, 29}, {1, 32, 31});
    frame::DrawnModel model(scene.model());
    plan::View view = frame::overGround();
    view.towardsLight = {0, 1, 1};
    expectByHand(model, view, glm::dvec3(0), kMargin, [](double x, double z) {
        return std::abs(x) < 1 && z > 29 - 32 && z < 31 - 30;
    });
}

TEST(ShadowsByHand, OfABoxAHundredFrustaUpTheLight) {
    tests::SceneMesh scene;
    scene.addGround(64, 8);
    const double up = 6400;
    scene.addBox({up - 1, up, -1}, {up + 1, up + 2, 1});
    frame::DrawnModel model(scene.model());
    expectByHand(model, frame::overGround(), glm::dvec3(0), kMargin, crateShadow);
}

/// A frame of few texels, beside what rays say of it.
FrameValidation judgedWithCoarseTexels(const tests::SceneMesh& scene) {
    frame::DrawnModel model(scene.model());
    plan::View view = frame::overGround();
    view.towardsLight = {0.3, 1, 0.2};
    plan::Quality quality = frame::inSlices(1);
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 128;
    ValidationOptions options;
    options.groundTruth = GroundTruth::SameDetail;
    return validate(model.renderer(), model.draw(view, quality), options);
}

TEST(ShadowTruth, CountsABarThinnerThanATexelApart) {
    tests::SceneMesh scene = frame::crateOnGround();
    scene.addBox({-20, 3, 4}, {20, 3.03, 4.03});
    const FrameValidation proof = judgedWithCoarseTexels(scene);
    ASSERT_TRUE(proof.truth);
    const ShadowTruth& truth = *proof.truth;
    EXPECT_GT(truth.missedPixels, 20U);
    EXPECT_EQ(truth.answerable.wrongPixels + truth.missedPixels, truth.shadows.wrongPixels);
    EXPECT_GT(truth.answerable.edgePixelsApart, 50U);
    EXPECT_GT(truth.answerable.edgePixels, 50U) << "the crate's edges are not apart";
    EXPECT_LT(truth.answerable.edgeWorstPixels, truth.shadows.edgeWorstPixels);
    telemetry::FrameRow row;
    setAccuracy(proof, row);
    EXPECT_EQ(*row.shadowEdgeP99Px, truth.answerable.edgeP99Pixels);
}

// What lies in the slit is lit and none of it is missed: only its edges are apart.
TEST(ShadowTruth, CountsTheEdgesOfASlitNarrowerThanATexelApart) {
    tests::SceneMesh scene = frame::crateOnGround();
    scene.addBox({-20, 3, -3}, {20, 3.1, -0.06});
    scene.addBox({-20, 3, 0.06}, {20, 3.1, 3});
    const FrameValidation proof = judgedWithCoarseTexels(scene);
    ASSERT_TRUE(proof.truth);
    EXPECT_GT(proof.truth->answerable.edgePixelsApart, proof.truth->missedPixels + 50);
}

} // namespace
} // namespace gnomon::validation
