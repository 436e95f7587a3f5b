// Cells and extents of samples by lanes against a look at each, and the arrays that samples lie in.
#include "exact/cell_kernel.h"
#include "exact/frame_array.h"
#include "tests/exact/random.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::exact {
namespace {

/// A list of `count` samples at random places, or at none, of `maps` maps.
void scatter(SampleList& samples, RandomWholes& random, std::size_t count, int maps) {
    SampleSpace space;
    space.maps = maps;
    samples.reset(space, count);
    for (std::size_t i = 0; i < count; ++i) {
        samples.u[i] = random.whole(0, 20) == 0 ? std::nan("") : random.real(-100, 100);
        samples.v[i] = random.real(-100, 100);
        samples.h[i] = random.real(-100, 100);
        if (maps > 1) samples.map[i] = static_cast<std::int32_t>(random.whole(0, maps - 1));
    }
}

glm::dmat4x3 somePlane(RandomWholes& random) {
    glm::dmat4x3 plane;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 3; ++row)
            plane[column][row] = random.whole(0, 9) == 0 ? 0 : random.real(-1, 1);
    return plane;
}

Extent plainExtent(const glm::dmat4x3& plane, std::size_t map, const SampleRun& run) {
    Extent extent;
    for (std::size_t i = run.begin; i < run.end; ++i) {
        if (run.samples->mapOf(i) != map) continue;
        const glm::dvec3 p = plane * glm::dvec4(run.samples->u[i], run.samples->v[i], run.samples->h[i], 1);
        const glm::dvec2 place = glm::dvec2(p) / p.z;
        ++extent.samples;
        extent.minW = std::min(extent.minW, p.z);
        extent.maxW = std::max(extent.maxW, p.z);
        extent.min = glm::min(extent.min, place);
        extent.max = glm::max(extent.max, place);
    }
    return extent;
}

TEST(CellKernel, FindsWhatALookAtEachFinds) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        SCOPED_TRACE(seed);
        RandomWholes random(seed);
        const auto count = static_cast<std::size_t>(random.whole(1, 99));
        const int maps = static_cast<int>(random.whole(1, 3));
        const int side = static_cast<int>(random.whole(1, 300));
        SampleList samples;
        scatter(samples, random, count, maps);
        const glm::dmat4x3 plane = somePlane(random);
        const auto map = static_cast<std::size_t>(random.whole(0, maps - 1));
        const SampleRun run{&samples, static_cast<std::size_t>(random.whole(0, 3)) % count, count};
        const Extent plain = plainExtent(plane, map, run);
        tests::onEachTarget([&](const char* target) {
            SCOPED_TRACE(target);
            const Extent extent = extentOn(plane, map, run);
            EXPECT_EQ(extent.samples, plain.samples);
            EXPECT_EQ(extent.minW, plain.minW);
            EXPECT_EQ(extent.maxW, plain.maxW);
            EXPECT_EQ(extent.min, plain.min);
            EXPECT_EQ(extent.max, plain.max);
            std::vector<std::uint32_t> cells(count + 16, 12345678);
            findCells(plane, map, side, run, cells);
            for (std::size_t i = run.begin; i < count; ++i) {
                const glm::dvec3 p = plane * glm::dvec4(samples.u[i], samples.v[i], samples.h[i], 1);
                const int cell = cellAt(p.y / p.z, side) * side + cellAt(p.x / p.z, side);
                EXPECT_EQ(cells[i - run.begin], samples.mapOf(i) == map ? static_cast<std::uint32_t>(cell) : 12345678U);
            }
        });
    }
}

TEST(FrameArray, KeepsWhatItHasRoomFor) {
    FrameArray<int> values;
    EXPECT_EQ(values.begin(), values.end());
    values.ensureCapacity(3);
    for (std::size_t i = 0; i < 3; ++i)
        values[i] = static_cast<int>(i);
    values.ensureCapacity(2);
    EXPECT_EQ(values.size(), 3U);
    EXPECT_TRUE(std::equal(values.begin(), values.end(), std::vector{0, 1, 2}.begin()));
    FrameArray<int> others;
    others.ensureCapacity(7);
    others.swap(values);
    EXPECT_EQ(values.size(), 7U);
    EXPECT_EQ(others[2], 2);
    others.ensureCapacity(4);
    EXPECT_EQ(others.size(), 4U);
}

} // namespace
} // namespace gnomon::exact
