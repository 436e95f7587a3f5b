// What proofs find, by themselves: shares, crawl of frames that are known, aliasing against its promise, truth of
// shadows.
#include "tests/support/crate_scene.h"
#include "tests/support/drawn_model.h"
#include "validation/crawl.h"
#include "validation/measured_aliasing.h"
#include "validation/shadow_truth.h"

#include <gtest/gtest.h>

namespace gnomon::validation {
namespace {

TEST(Findings, HaveSharesAlsoOfNothing) {
    EXPECT_EQ((Crawl{0, 0}.share()), 0);
    EXPECT_EQ((Crawl{8, 2}.share()), 0.25);
    EXPECT_EQ((MeasuredAliasing{2, 3, 0, 0, 0}.worst()), 3);
    EXPECT_EQ((MeasuredAliasing{4, 3, 0, 0, 0}.worst()), 4);
    ShadowTruth truth;
    EXPECT_EQ(truth.missedFraction(), 0);
    EXPECT_EQ(truth.unexplainedFraction(), 0);
    truth.shadows.litSidePixels = 10;
    truth.missedPixels = 1;
    truth.judgedPixels = 4;
    truth.unexplainedPixels = 3;
    EXPECT_EQ(truth.missedFraction(), 0.1);
    EXPECT_EQ(truth.unexplainedFraction(), 0.75);
}

/// A frame of a crate on the ground with its surfaces.
class DrawnCrate : public testing::Test {
protected:
    frame::DrawnModel model{frame::crateOnGround().model()};

    static frame::FrameOptions withSurfaces() {
        frame::FrameOptions options;
        options.wantsSurfaces = true;
        return options;
    }

    const frame::FrameOptions options = withSurfaces();
    const frame::Frame frame = model.draw(frame::overGround(), frame::inSlices(1), options);
    const render::DrawInputs drawing = model.renderer().drawing(frame, options);
    const render::Raster<render::SurfaceSample> surfaces = model.backend().surfaces();
};

TEST_F(DrawnCrate, DoesNotCrawlWhileNothingMovesAndAllOfItsShadowDoesWhereAllIsLit) {
    const render::FloatPicture depth = model.backend().shadowDepth();
    const Crawl still = crawl({&drawing, &depth}, surfaces, {&drawing, &depth});
    EXPECT_GT(still.points, 1000U);
    EXPECT_EQ(still.changed, 0U);
    std::uint64_t dark = 0;
    for (const render::SurfaceSample& sample : surfaces.pixels)
        dark += sample.isLitSide() && sample.partition() >= 0 && sample.litFraction() == 0 ? 1 : 0;
    EXPECT_GT(dark, 100U);
    render::FloatPicture empty = depth; // no caster: the value of texels that nothing was drawn to
    std::fill(empty.pixels.begin(), empty.pixels.end(), *std::max_element(depth.pixels.begin(), depth.pixels.end()));
    const Crawl gone = crawl({&drawing, &depth}, surfaces, {&drawing, &empty});
    EXPECT_EQ(gone.points, still.points);
    EXPECT_EQ(gone.changed, dark);
}

TEST_F(DrawnCrate, HasNoMoreAliasingThanItsPlanPromises) {
    const MeasuredAliasing found = measuredAliasing(drawing, surfaces);
    EXPECT_GT(found.pixelsMeasured, 1000U);
    EXPECT_EQ(found.pixelsWithoutBound, 0U);
    EXPECT_GT(found.worst(), 0);
    EXPECT_LE(found.overBound, 1.001);
    const shadow::ShadowMap& map = frame.plan.passes.at(0).map;
    EXPECT_LE(found.x, map.aliasingBound.x * 1.001);
    EXPECT_LE(found.z, map.aliasingBound.z * 1.001);
}

} // namespace
} // namespace gnomon::validation
