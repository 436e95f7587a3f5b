// Parts of the backends that are tested by themselves: what stands in for finer clusters, batches, rows turned over.
#include "core/random.h"
#include "plan/plan_frame.h"
#include "render/gl/gl_targets.h"
#include "render/lod_substitutes.h"
#include "render/ray_shadows.h"
#include "render/shading_batch.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

namespace gnomon::render {
namespace {

TEST(FlippedRows, AreThoseFromBelowAndTwiceFlippedAsTheyWere) {
    for (const int width : {1, 3})
        for (const int height : {0, 1, 2, 5, 6}) {
            Raster<int> raster;
            raster.width = width;
            raster.height = height;
            for (int i = 0; i < width * height; ++i)
                raster.pixels.push_back(i);
            const std::vector<int> before = raster.pixels;
            flipRows(raster);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    EXPECT_EQ(raster.at(x, y), (height - 1 - y) * width + x);
            flipRows(raster);
            EXPECT_EQ(raster.pixels, before);
        }
}

TEST(PixelBatch, IsFilledUpWithItsLastPixel) {
    for (const std::size_t count : {0U, 1U, 15U, 16U, 17U, 127U, 128U}) {
        PixelBatch batch;
        batch.count = count;
        for (std::size_t i = 0; i < count; ++i) {
            batch.x[i] = batch.y[i] = batch.litMask[i] = static_cast<float>(i + 1);
            batch.corner[2][i] = batch.edge1[1][i] = batch.edge2[0][i] = static_cast<std::int32_t>(i + 1);
            batch.normals[0][i] = batch.colors[2][i] = static_cast<std::uint32_t>(i + 1);
        }
        batch.pad();
        EXPECT_EQ(batch.count, count);
        for (std::size_t i = 0; i < PixelBatch::kMaxPixels; ++i) {
            const std::size_t end = (count + 15) / 16 * 16;
            const std::size_t value = i < count ? i + 1 : i < end ? count : 0;
            EXPECT_EQ(batch.x[i], static_cast<float>(value)) << count << " " << i;
            EXPECT_EQ(batch.y[i], batch.x[i]);
            EXPECT_EQ(batch.litMask[i], batch.x[i]);
            for (const std::int32_t found : {batch.corner[2][i], batch.edge1[1][i], batch.edge2[0][i]})
                EXPECT_EQ(found, static_cast<std::int32_t>(value));
            EXPECT_EQ(batch.normals[0][i], value);
            EXPECT_EQ(batch.colors[2][i], value);
        }
    }
}

/// Pages of 20 clusters, some of which stand in for finer ones, and a list that draws some of each page.
struct SubstitutedImage {
    explicit SubstitutedImage(Random& random) : pages(1 + random.below(4)) {
        for (std::uint32_t page = 0; page < pages.size(); ++page) {
            pages[page].clusters.resize(20);
            for (std::uint32_t c = 0; c < 20; ++c)
                addCluster(random, page, c);
            const auto first = static_cast<std::uint32_t>(random.below(10));
            image.ranges.push_back({page, first, static_cast<std::uint32_t>(1 + random.below(10))});
            drawn += image.ranges.back().clusterCount;
        }
    }

    void addCluster(Random& random, std::uint32_t page, std::uint32_t cluster) {
        pages[page].clusters[cluster].triangleCount = static_cast<std::uint32_t>(1 + random.below(128));
        if (random.below(3) != 0) return;
        const Residence reason = random.below(2) == 0 ? Residence::Pending : Residence::Damaged;
        plain[{page, cluster}] = reason;
        substitutes.push_back({page, cluster, reason});
    }

    Residence reasonOf(std::uint32_t page, std::uint32_t cluster) const {
        const auto place = plain.find({page, cluster});
        return place == plain.end() ? Residence::Final : place->second;
    }

    std::vector<hierarchy::Page> pages;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Residence> plain; // beside the sorted list
    std::vector<LodSubstitute> substitutes;
    lod::DrawList image;
    std::uint64_t drawn = 0;
};

TEST(LodSubstitutes, PartWhatIsDrawnByItsReason) {
    Random random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const SubstitutedImage all(random);
        const auto lookUp = [&](std::uint32_t page) -> const hierarchy::Page& { return all.pages[page]; };
        std::uint64_t clusters = 0;
        for (const Residence reason : {Residence::Final, Residence::Pending, Residence::Damaged}) {
            const lod::DrawList found = drawnAs(all.image, all.substitutes, reason, lookUp);
            std::uint64_t triangles = 0;
            for (const auto& [page, cluster, count] : found.ranges) {
                EXPECT_EQ(all.reasonOf(page, cluster), reason);
                EXPECT_EQ(residenceOf(all.substitutes, page, cluster), reason);
                EXPECT_EQ(count, 1U);
                triangles += all.pages[page].clusters[cluster].triangleCount;
            }
            EXPECT_EQ(found.clusters, found.ranges.size());
            EXPECT_EQ(found.triangles, triangles);
            clusters += found.clusters;
        }
        EXPECT_EQ(clusters, all.drawn) << "each once";
    }
}

TEST(RayShadows, TheLightIsWhereTheViewHasIt) {
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        plan::View view;
        view.camera.eye = {random.uniform(-5, 5), random.uniform(1, 5), random.uniform(-5, 5)};
        view.towardsLight = {random.uniform(-1, 1), random.uniform(0.1, 1), random.uniform(-1, 1)};
        plan::SceneFacts facts;
        facts.bounds = {{-10, 0, -10}, {10, 2, 10}};
        plan::FramePlan plan = plan::planFrame(view, {}, facts).plan;
        DrawInputs drawing;
        drawing.plan = &plan;
        drawing.grid = {{-1, -2, -3}, -4};
        drawing.space.originCell = {16, 32, 48};
        const glm::vec3 somewhere(random.uniform(-9, 9), 1, 2);
        EXPECT_EQ(lightSource(drawing).from(somewhere), glm::vec3(view.light().unit()));
        EXPECT_FALSE(lightSource(drawing).distance(somewhere) < 1e30F);
        plan.view.pointLight = {{3, 4, 12}, 1}; // from the origin of camera-relative space, at 0, 0, 0
        const raytrace::LightSource lamp = lightSource(drawing);
        EXPECT_LT(glm::length(lamp.from(glm::vec3(0)) - glm::vec3(3, 4, 12) / 13.0F), 1e-6F);
        EXPECT_EQ(lamp.distance(glm::vec3(3, 4, 2)), 10);
    }
}

} // namespace
} // namespace gnomon::render
