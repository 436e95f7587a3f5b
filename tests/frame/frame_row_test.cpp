// The row of the log against a frame that is put together by hand.
#include "frame/frame_row.h"

#include <gtest/gtest.h>

#include <numbers>

namespace gnomon::frame {
namespace {

/// An image and two maps, the first of them left by the frame before.
PreparedFrame frameOfTwoMaps() {
    PreparedFrame frame;
    frame.plan.passes.resize(2);
    frame.plan.passes[0].isReused = true;
    frame.plan.splits = {1, 4, 16};
    frame.plan.near = 1;
    frame.plan.far = 16;
    frame.plan.lightAngleRadians = std::numbers::pi / 3;
    frame.cut.lists.casters.resize(2);
    frame.cut.lists.image.triangles = 1000;
    frame.cut.lists.casters[0].triangles = 200;
    frame.cut.lists.casters[0].clusters = 2;
    frame.cut.lists.casters[1].triangles = 30;
    frame.cut.lists.casters[1].clusters = 3;
    frame.cut.clustersTested = 77;
    frame.residency.pagesMissing = 5;
    frame.planMs = 0.5;
    frame.streamMs = 0.25;
    return frame;
}

telemetry::FrameRow rowOf(const PreparedFrame& frame) {
    render::DrawStatistics drawn;
    drawn.shadows = {{7}, 4, 9000};
    drawn.image = {{8}, 3, std::nullopt};
    drawn.deviceMemory = {4096};
    lod::StoreStatistics residency;
    residency.resident = {123};
    return frameRow(frame, drawn, {"a.gnm", "software", residency});
}

TEST(FrameRow, CountsTheMapsThatWereDrawnAndAllCasters) {
    const telemetry::FrameRow row = rowOf(frameOfTwoMaps());
    EXPECT_EQ(row.shadowMaps, 2);
    EXPECT_EQ(row.imageWidthDrawn, 800);
    EXPECT_EQ(row.samplesPerPixel, 1);
    EXPECT_EQ(row.shadowMapsDrawn, 1);
    EXPECT_EQ(row.zPartitions, 2);
    EXPECT_EQ(row.imageTriangles, 1000);
    EXPECT_EQ(row.shadowTriangles, 30) << "of the map that was drawn";
    EXPECT_EQ(row.castersKept, 5);
    EXPECT_EQ(row.castersTested, 77);
    EXPECT_EQ(row.shadowFragments, 9000);
    EXPECT_EQ(row.drawCalls, 7);
    EXPECT_EQ(row.shadowMs, 7);
    EXPECT_EQ(row.imageMs, 8);
    EXPECT_EQ(row.planMs, 0.5);
    EXPECT_EQ(row.streamMs, 0.25);
    EXPECT_EQ(row.gpuBytes, 4096);
    EXPECT_EQ(row.residentBytes, 123);
    EXPECT_EQ(row.pagesMissing, 5);
    EXPECT_EQ(row.depthRatio, 16);
    EXPECT_NEAR(*row.lightAngle, 60, 1e-12);
    EXPECT_EQ(row.model, "a.gnm");
    EXPECT_EQ(row.backend, "software");
    EXPECT_TRUE(row.isBoundKept);
}

TEST(FrameRow, PromisesNothingWithoutMaps) {
    PreparedFrame frame = frameOfTwoMaps();
    frame.plan.passes.clear();
    const telemetry::FrameRow row = rowOf(frame);
    EXPECT_EQ(row.shadowMaps, 0);
    EXPECT_EQ(row.shadowTriangles, 0);
    EXPECT_EQ(row.castersTested, 0);
    EXPECT_FALSE(row.isBoundKept);
    EXPECT_FALSE(row.aliasingBoundX);
    EXPECT_FALSE(row.storageFactor);
}

} // namespace
} // namespace gnomon::frame
