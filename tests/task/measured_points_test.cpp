// Points that are measured without a window: by pixels and by coordinates, on a quad that is known.
#include "core/error.h"
#include "inspect/cells.h"
#include "task/measured_points.h"
#include "tests/support/scene_mesh.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include <unistd.h>

namespace gnomon::task {
namespace {

const glm::dvec3 kFarAway(500000, 5000000, 300); // as of UTM

/// A model of one level quad, 16 by 10, two above the place of its middle; gone at the end.
class LevelQuad : public testing::Test {
protected:
    void SetUp() override {
        tests::SceneMesh scene(kFarAway);
        scene.addQuad({-8, 2, -5}, {16, 0, 0}, {0, 0, 10});
        tests::writeModel(scene.model(), path_);
        task.model = path_;
        task.warn = [](const std::string& warning) { FAIL() << warning; };
        task.settings.imageSize = {160, 160};
        task.settings.eye = kFarAway + glm::dvec3(0, 22, 0);
        task.settings.target = kFarAway;
        task.settings.up = {0, 0, -1};
        task.settings.fovYDegrees = 60;
    }

    void TearDown() override { std::filesystem::remove(path_); }

    /// The point of the quad's plane that the middle of a pixel shows, from 20 above it.
    static glm::dvec3 shown(const glm::ivec2& pixel, double halfHeight) {
        const glm::dvec2 across = (glm::dvec2(pixel) + 0.5) / 80.0 - 1.0;
        return kFarAway + glm::dvec3(across.x * halfHeight, 2, across.y * halfHeight);
    }

    PointTask task;

private:
    std::string path_ =
        (std::filesystem::temp_directory_path() / ("gnomon_quad_" + std::to_string(::getpid()) + ".gnm")).string();
};

TEST_F(LevelQuad, PixelsShowThePointsOfTheQuad) {
    for (const Projection projection : {Projection::Perspective, Projection::Orthographic}) {
        task.settings.projection = projection;
        const double distance = projection == Projection::Perspective ? 20 : 22;
        task.pixels = {{80, 80}, {101, 63}, {60, 95}, {84, 99}};
        const MeasuredPoints found = measurePoints(task);
        ASSERT_EQ(found.measure.size(), task.pixels.size());
        for (std::size_t i = 0; i < task.pixels.size(); ++i) {
            const glm::dvec3 expected = shown(task.pixels[i], distance * std::sqrt(1 / 3.0));
            const glm::dvec3 at = inspect::worldOf(found.of.grid, found.measure[i].cell);
            EXPECT_LE(glm::distance(at, expected), 0.9 * found.of.grid.step()) << i;
            EXPECT_EQ(at.y, kFarAway.y + 2);
            EXPECT_LE(found.measure[i].within, 2 * found.of.grid.snapError());
        }
        EXPECT_EQ(inspect::figuresOf(found.measure, found.of).offPlane, 0);
    }
}

TEST_F(LevelQuad, VerticesAreItsCorners) {
    task.takesVertices = true;
    task.pixels = {{55, 60}, {105, 60}, {105, 98}, {55, 98}};
    const MeasuredPoints found = measurePoints(task);
    const inspect::Figures figures = inspect::figuresOf(found.measure, found.of);
    EXPECT_EQ(figures.legs, (std::vector<double>{16, 10, 16}));
    EXPECT_EQ(figures.perimeter, 52);
    EXPECT_EQ(figures.area, 160);
    EXPECT_EQ(inspect::worldOf(found.of.grid, found.measure[0].cell), kFarAway + glm::dvec3(-8, 2, -5));
}

TEST_F(LevelQuad, WhatCannotBeMeasuredIsSaid) {
    task.pixels = {{2, 2}};
    EXPECT_THROW((void)measurePoints(task), Error); // beside it
    task.pixels = {};
    task.points = {kFarAway + glm::dvec3(1, 2, 3), kFarAway + glm::dvec3(4, 6, 3)};
    const MeasuredPoints found = measurePoints(task);
    EXPECT_NEAR(inspect::figuresOf(found.measure, found.of).straight, 5, 2 * found.of.grid.step());
    task.points.emplace_back(1e300, 0, 0);
    EXPECT_THROW((void)measurePoints(task), Error);
}

} // namespace
} // namespace gnomon::task
