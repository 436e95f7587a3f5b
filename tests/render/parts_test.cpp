// The backends' parts by themselves: free ranges, pictures on disk, packed vertices, passes and the space they draw
// in.
#include "core/error.h"
#include "core/file.h"
#include "core/random.h"
#include "render/backend.h"
#include "render/gl/free_list.h"
#include "render/gl/geometry_pool.h"
#include "render/gl/gl_batch.h"
#include "render/picture.h"
#include "render/shading_kernel.h"
#include "render/software_pass.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>

#include <unistd.h>

namespace gnomon::render {
namespace {

// Every unit as a flag, beside the list.
TEST(FreeList, TakesTheFirstRangeThatIsLargeEnough) {
    Random random(1);
    constexpr std::size_t kUnits = 200;
    FreeList list(kUnits);
    std::vector<bool> taken(kUnits);
    std::map<std::size_t, std::size_t> ranges;
    int refused = 0;
    for (int i = 0; i < 5000; ++i) {
        if (random.below(2) == 0 && !ranges.empty()) {
            const auto [offset, units] =
                *std::next(ranges.begin(), static_cast<std::ptrdiff_t>(random.below(ranges.size())));
            list.release(offset, units);
            ranges.erase(offset);
            std::fill_n(taken.begin() + static_cast<std::ptrdiff_t>(offset), units, false);
            continue;
        }
        const std::size_t units = 1 + random.below(30);
        std::optional<std::size_t> expected;
        for (std::size_t run = 0, at = 0; at < kUnits && !expected; ++at) {
            run = taken[at] ? 0 : run + 1;
            if (run < units) continue;
            std::size_t first = at + 1 - run;
            while (first > 0 && !taken[first - 1])
                --first;
            expected = first;
        }
        const std::optional<std::size_t> found = list.take(units);
        ASSERT_EQ(found, expected);
        if (!found) {
            ++refused;
            continue;
        }
        std::fill_n(taken.begin() + static_cast<std::ptrdiff_t>(*found), units, true);
        ranges[*found] = units;
    }
    EXPECT_GT(refused, 50);
    EXPECT_FALSE(FreeList().take(1));
    EXPECT_FALSE(FreeList(0).take(1));
}

class PictureFile : public testing::Test {
protected:
    void TearDown() override { std::filesystem::remove(path); }

    std::string path = testing::TempDir() + "gnomon_picture_" + std::to_string(::getpid());
};

Picture randomPicture(Random& random, int width, int height) {
    Picture picture(width, height);
    for (Rgb& pixel : picture.pixels)
        for (std::uint8_t& channel : pixel)
            channel = static_cast<std::uint8_t>(random.bits());
    return picture;
}

TEST_F(PictureFile, APngComesBackPixelForPixel) {
    Random random(2);
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(7, 3), std::pair(64, 65)}) {
        const Picture picture = randomPicture(random, width, height);
        writePng(path, picture);
        const Picture back = readPng(path);
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        EXPECT_EQ(back.pixels, picture.pixels);
        const std::string file = readTextFile(path);
        const std::vector<std::uint8_t> bytes = pngBytes(picture);
        EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), file.begin(), file.end(), [](std::uint8_t a, char b) {
            return a == static_cast<std::uint8_t>(b);
        })) << "what is written is what is answered";
    }
}

TEST_F(PictureFile, WhatIsNoPngIsNamed) {
    Random random(3);
    writePng(path, randomPicture(random, 20, 20));
    const std::string good = readTextFile(path);
    for (const std::string& bad : {std::string(), std::string("nothing"), good.substr(0, good.size() / 2)}) {
        writeTextFile(path, bad);
        try {
            readPng(path);
            ADD_FAILURE() << bad.size();
        } catch (const Error& error) {
            EXPECT_EQ(std::string(error.what()).find(path + ": cannot be read as PNG: "), 0U) << error.what();
        }
    }
}

TEST_F(PictureFile, APfmHasItsLowestRowFirst) {
    FloatPicture picture(3, 2);
    for (int i = 0; i < 6; ++i)
        picture.pixels[static_cast<std::size_t>(i)] = static_cast<float>(i) + 0.5F;
    writePfm(path, picture);
    const std::string file = readTextFile(path);
    const std::string header = "Pf\n3 2\n-1.0\n";
    ASSERT_EQ(file.substr(0, header.size()), header);
    ASSERT_EQ(file.size(), header.size() + 24);
    std::array<float, 6> values{};
    std::memcpy(values.data(), file.data() + header.size(), 24);
    EXPECT_EQ(values, (std::array{3.5F, 4.5F, 5.5F, 0.5F, 1.5F, 2.5F}));
}

TEST(PictureDifference, IsThatOfThePixelsOneByOne) {
    Random random(4);
    const Picture a = randomPicture(random, 20, 10);
    Picture b = a;
    EXPECT_EQ(difference(a, b).mean, 0);
    EXPECT_EQ(difference(a, b).largest, 0);
    b.at(3, 4)[1] = static_cast<std::uint8_t>(a.at(3, 4)[1] < 128 ? a.at(3, 4)[1] + 100 : a.at(3, 4)[1] - 100);
    b.at(0, 0)[2] = static_cast<std::uint8_t>(a.at(0, 0)[2] < 128 ? a.at(0, 0)[2] + 2 : a.at(0, 0)[2] - 2);
    EXPECT_DOUBLE_EQ(difference(a, b).mean, 102.0 / (200 * 3 * 255));
    EXPECT_DOUBLE_EQ(difference(b, a).largest, 100.0 / 255);
    EXPECT_DOUBLE_EQ(difference(a, b).changedFraction, 1.0 / 200) << "two levels are not seen";
    b.at(0, 0)[2] = static_cast<std::uint8_t>(a.at(0, 0)[2] < 128 ? a.at(0, 0)[2] + 3 : a.at(0, 0)[2] - 3);
    EXPECT_DOUBLE_EQ(difference(a, b).changedFraction, 2.0 / 200) << "three are";
    EXPECT_THROW(difference(a, Picture(10, 20)), Error);
}

TEST(PackedVertices, CarryTheErrorAndABitOfEachAxisAndNothingElse) {
    tests::TinyModelOptions options;
    options.colors = true;
    options.normals = true;
    const tests::TinyModel model = tests::makeTinyModel(options);
    const hierarchy::Grid& grid = model.summary.grid;
    std::map<std::uint32_t, int> tints;
    for (std::uint32_t id = 0; id < model.pages.size(); ++id) {
        const hierarchy::Page& page = model.pages[id];
        const std::vector<PackedVertex> packed = packedVertices(id, page, grid);
        ASSERT_EQ(packed.size(), page.vertices.size());
        for (const hierarchy::Cluster& cluster : page.clusters) {
            const double error = storedError(page, cluster, grid);
            EXPECT_EQ(
                error,
                cluster.refinement == hierarchy::kNone ? grid.snapError() : page.refinements[cluster.refinement].error);
            for (std::uint32_t v = cluster.firstVertex; v < cluster.firstVertex + cluster.vertexCount; ++v) {
                const hierarchy::Vertex& vertex = page.vertices[v];
                EXPECT_EQ(packed[v].position.x & 0x7FFFFFFFU, vertex.position.x);
                EXPECT_EQ(packed[v].position.y & 0x7FFFFFFFU, vertex.position.y);
                EXPECT_EQ(packed[v].position.z & 0x7FFFFFFFU, vertex.position.z);
                EXPECT_EQ(packed[v].normal, vertex.normal);
                EXPECT_EQ(packed[v].color & 0xFFFFFFU, vertex.color & 0xFFFFFFU);
                const double decoded = grid.step() * std::exp2((static_cast<double>(packed[v].color >> 24U) - 9) / 8);
                EXPECT_GE(decoded, error * (1 - 1e-12)) << "rounded up";
                EXPECT_LE(decoded, error * std::exp2(1.0 / 8) * (1 + 1e-12)) << "by an eighth of an octave at most";
            }
            const hierarchy::GridPoint& p = packed[cluster.firstVertex].position;
            ++tints[(p.x >> 31U) | (p.y >> 31U) << 1U | (p.z >> 31U) << 2U];
        }
    }
    EXPECT_EQ(tints.size(), 8U) << "clusters are told apart by all three bits";
}

std::uint32_t below(Random& random, std::uint32_t end) {
    return static_cast<std::uint32_t>(random.bits() % end);
}

/// A page of `count` clusters whose corners are random.
hierarchy::Page randomPage(Random& random, std::uint32_t count) {
    hierarchy::Page page;
    for (std::uint32_t c = 0; c < count; ++c) {
        hierarchy::Cluster cluster;
        cluster.firstVertex = static_cast<std::uint32_t>(page.vertices.size());
        cluster.firstTriangle = static_cast<std::uint32_t>(page.triangles.size());
        cluster.vertexCount = 3 + below(random, 254);
        cluster.triangleCount = 1 + below(random, 8);
        page.vertices.resize(page.vertices.size() + cluster.vertexCount);
        for (std::uint32_t t = 0; t < cluster.triangleCount; ++t) {
            std::array<std::uint8_t, 3> corners{};
            for (std::uint8_t& corner : corners)
                corner = static_cast<std::uint8_t>(below(random, cluster.vertexCount));
            page.triangles.push_back(corners);
        }
        page.clusters.push_back(cluster);
    }
    return page;
}

/// Against the page itself: every triangle of a range is drawn once and in order, with its own vertices, in a page of
/// more vertices than 16 bits count.
TEST(DrawCommands, NameEveryTriangleOfARangeWithItsOwnVertices) {
    Random random(3);
    const hierarchy::Page page = randomPage(random, 600);
    ASSERT_GT(page.vertices.size(), 65536U);
    const std::vector<std::uint16_t> indices = packedIndices(page);
    const PagePlace place{2, 1000, 5000};
    for (int i = 0; i < 100; ++i) {
        lod::ClusterRange range;
        range.firstCluster = below(random, 600);
        range.clusterCount = 1 + below(random, 600 - range.firstCluster);
        std::vector<std::int64_t> expected;
        for (std::uint32_t c = range.firstCluster; c < range.firstCluster + range.clusterCount; ++c)
            for (std::uint32_t t = 0; t < page.clusters[c].triangleCount; ++t)
                for (const std::uint8_t corner : page.triangles[page.clusters[c].firstTriangle + t])
                    expected.push_back(std::int64_t{place.baseVertex} + page.clusters[c].firstVertex + corner);
        std::vector<DrawCommand> commands;
        appendCommands(commands, place, page, range);
        std::vector<std::int64_t> drawn;
        for (const DrawCommand& command : commands)
            for (std::uint32_t k = 0; k < command.count; ++k)
                drawn.push_back(std::int64_t{command.baseVertex} + indices[command.firstIndex - place.firstIndex + k]);
        ASSERT_EQ(drawn, expected);
    }
}

TEST(SoftwarePass, HasTheClustersOfTheListInItsOrder) {
    const tests::TinyModel model = tests::makeTinyModel({});
    DrawInputs frame;
    frame.pages = [&](std::uint32_t page) -> const hierarchy::Page& { return model.pages[page]; };
    lod::DrawList list;
    list.ranges = {{2, 1, 2}, {0, 0, 1}};
    SoftwarePass pass;
    pass.gather(frame, list, Cutting::Whole);
    ASSERT_EQ(pass.clusters().size(), 3U);
    ASSERT_EQ(pass.drawn().size(), 3U);
    const std::array<std::pair<std::uint32_t, std::uint32_t>, 3> expected{{{2, 1}, {2, 2}, {0, 0}}};
    for (std::size_t i = 0; i < 3; ++i) {
        const hierarchy::Page& page = model.pages[expected.at(i).first];
        const hierarchy::Cluster& cluster = page.clusters[expected.at(i).second];
        EXPECT_EQ(pass.drawn()[i].pageId, expected.at(i).first);
        EXPECT_EQ(pass.drawn()[i].cluster, expected.at(i).second);
        EXPECT_EQ(pass.drawn()[i].page, &page);
        EXPECT_EQ(pass.drawn()[i].vertices, &page.vertices[cluster.firstVertex]);
        EXPECT_EQ(pass.clusters()[i].positions, &page.vertices[cluster.firstVertex].position.x);
        EXPECT_EQ(pass.clusters()[i].positionStride, sizeof(hierarchy::Vertex));
        EXPECT_EQ(pass.clusters()[i].vertexCount, cluster.vertexCount);
        EXPECT_EQ(pass.clusters()[i].triangles.size(), cluster.triangleCount);
        EXPECT_EQ(pass.clusters()[i].firstTriangleId, i << kTriangleBits);
    }
    pass.gather(frame, {}, Cutting::Whole);
    EXPECT_TRUE(pass.clusters().empty()) << "a pass holds what was gathered last";
}

TEST(RasterView, IsTheMatrixWithTheGridsStepInside) {
    Random random(5);
    CameraRelativeSpace space;
    space.originCell = {5, 6, 7};
    space.step = 0.125;
    glm::dmat4 clipFromDraw(0);
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            clipFromDraw[column][row] = random.uniform(-2, 2);
    const raster::PixelBox viewport{1, 2, 30, 40};
    const raster::View view = rasterView(space, clipFromDraw, viewport);
    EXPECT_EQ(view.eyeCell, glm::ivec3(5, 6, 7));
    EXPECT_EQ(view.viewport, viewport);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 cell(static_cast<float>(random.below(100)), static_cast<float>(random.below(100)), 3);
        const glm::vec4 byCell = view.clipFromCell * glm::vec4(cell, 1);
        const glm::vec4 byDraw = glm::mat4(clipFromDraw) * glm::vec4(cell * 0.125F, 1);
        EXPECT_LT(glm::distance(byCell, byDraw), 1e-4F);
    }
}

TEST(CameraRelativeSpace, HasItsOriginAtTheGridPointOfTheModelNearestTheEye) {
    const hierarchy::Grid grid{{1000, -50, 20}, -4};
    const Box bounds{{1000, -50, 20}, {1100, 0, 90}};
    Random random(6);
    for (int i = 0; i < 500; ++i) {
        plan::View view;
        view.camera.eye = {random.uniform(900, 1200), random.uniform(-100, 50), random.uniform(-50, 200)};
        view.camera.target = view.camera.eye + glm::dvec3(1, 0, 0);
        const CameraRelativeSpace space = cameraRelativeSpace(view, grid, bounds);
        EXPECT_EQ(space.step, 0.0625);
        const glm::dvec3 origin = grid.world(space.originCell);
        const glm::dvec3 nearest = glm::clamp(view.camera.eye, bounds.min, bounds.max);
        EXPECT_LE(glm::distance(origin, nearest), std::sqrt(3.0) * grid.step());
        EXPECT_LT(glm::distance(space.eye, view.camera.eye - origin), 1e-9);
        const glm::dvec4 eyeInCamera = space.cameraFromDraw * glm::dvec4(space.eye, 1);
        EXPECT_LT(glm::length(glm::dvec3(eyeInCamera)), 1e-9) << "the eye is the camera's origin";
        const glm::dvec4 ahead = space.cameraFromDraw * glm::dvec4(space.eye + glm::dvec3(2, 0, 0), 1);
        EXPECT_LT(glm::distance(glm::dvec3(ahead), glm::dvec3(0, 0, 2)), 1e-9) << "and looks along +z";
    }
}

/// The answers of a map of 16 by 16 texels whose columns from 8 on are lit, along a row in steps of a 64th of a texel,
/// under a kernel of `filter` texels.
std::vector<float> litAcrossAnEdge(int filter) {
    block::Frame frame{};
    frame.filterTexels = filter;
    frame.sliceCount = 1;
    frame.towardsLight = {0, 0, -1};
    block::Shadows shadows{};
    block::Partition& part = shadows.partitions[0];
    part.clipFromOffset = glm::mat4(1); // texels are camera-relative space's units
    part.texelScale = {1, 1};
    part.endTexel = {16, 16};
    part.byDepth = {0, 0, 1, 0};
    std::vector<float> depths(std::size_t{16} * 16);
    for (std::size_t i = 0; i < depths.size(); ++i)
        depths[i] = i % 16 < 8 ? 0.25F : 0.75F;
    ShadingFrame shared;
    shared.frame = &frame;
    shared.shadows = &shadows;
    shared.shadowDepth = depths.data();
    shared.shadowWidth = 16;
    shared.litSource = LitSource::Maps;
    std::vector<float> answers;
    for (int first = 0; first < 16 * 64; first += 128) {
        PointBatch points;
        points.count = 128;
        for (std::size_t i = 0; i < points.count; ++i) {
            points.position[0][i] = static_cast<float>(first + static_cast<int>(i)) / 64;
            points.position[1][i] = 7.3F;
            points.position[2][i] = 0.5F;
            points.normal[2][i] = -1;
        }
        lookUpShadows(shared, points);
        answers.insert(answers.end(), points.lit.begin(), points.lit.begin() + points.count);
    }
    return answers;
}

TEST(Filter, HasARampAsWideAsItsKernelLessATexelAndNoSteps) {
    for (const int filter : {2, 3, 4, 5, 8}) {
        SCOPED_TRACE(filter);
        const std::vector<float> lit = litAcrossAnEdge(filter);
        const float half = 0.5F * static_cast<float>(filter - 1);
        for (std::size_t i = 0; i < lit.size(); ++i) {
            const float fromEdge = static_cast<float>(i) / 64 - 8;
            const float wanted = std::clamp((fromEdge + half) / (2 * half), 0.0F, 1.0F);
            ASSERT_NEAR(lit[i], wanted, 1e-6F) << "at " << fromEdge << " texels";
            if (wanted == 0 || wanted == 1) {
                ASSERT_EQ(lit[i], wanted);
            }
        }
    }
    for (const int none : {0, 1})
        for (const float lit : litAcrossAnEdge(none))
            EXPECT_TRUE(lit == 0 || lit == 1);
}

TEST(SurfaceSample, TellsTheMapTheLightAndTheSide) {
    SurfaceSample none;
    EXPECT_FALSE(none.isLitSide());
    SurfaceSample dark;
    dark.isSurface = 1;
    dark.partitionAndLit = -1;
    EXPECT_FALSE(dark.isLitSide());
    for (const int map : {-1, 0, 3})
        for (const float lit : {0.0F, 0.25F, 0.75F}) {
            SurfaceSample sample;
            sample.isSurface = 1;
            sample.partitionAndLit = static_cast<float>(map) + 1 + lit / 2;
            EXPECT_TRUE(sample.isLitSide());
            EXPECT_EQ(sample.partition(), map);
            EXPECT_NEAR(sample.litFraction(), lit, 1e-6F);
        }
}

} // namespace
} // namespace gnomon::render
