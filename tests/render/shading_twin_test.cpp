// The shading kernel against plain code: identical bytes on every instruction set; and whole frames on all of them.
#include "core/random.h"
#include "render/frame_block.h"
#include "render/software_backend.h"
#include "render/software_shading.h"
#include "tests/support/field.h"
#include "tests/support/plain_shading.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <bit>
#include <cmath>
#include <cstring>

#include <hwy/highway.h>

namespace gnomon::render {
namespace {

/// Runs `draw` on every instruction set that this machine has.
template <class Draw>
void onEveryTarget(const Draw& draw) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
        SCOPED_TRACE(hwy::TargetName(target));
        draw();
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

template <class T>
std::size_t differences(const PixelBatch::Values<T>& a, const PixelBatch::Values<T>& b, std::size_t count) {
    std::size_t result = 0;
    for (std::size_t i = 0; i < count; ++i)
        result += std::bit_cast<std::uint32_t>(a[i]) == std::bit_cast<std::uint32_t>(b[i]) ? 0U : 1U;
    return result;
}

void expectSame(const PixelBatch& a, const PixelBatch& b) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(differences(a.position[axis], b.position[axis], a.count), 0U);
        EXPECT_EQ(differences(a.flatNormal[axis], b.flatNormal[axis], a.count), 0U);
        EXPECT_EQ(differences(a.shaded[axis], b.shaded[axis], a.count), 0U);
    }
    EXPECT_EQ(differences(a.depth, b.depth, a.count), 0U);
    EXPECT_EQ(differences(a.lit, b.lit, a.count), 0U);
    EXPECT_EQ(differences(a.pass, b.pass, a.count), 0U);
    EXPECT_EQ(differences(a.faces, b.faces, a.count), 0U);
    EXPECT_EQ(differences(a.color, b.color, a.count), 0U);
}

std::uint32_t randomNormal(Random& random) {
    constexpr std::array<std::uint32_t, 4> kOdd = {0x80008000U, 0U, 0x80017FFFU, 0x7FFF8000U};
    const std::uint64_t kind = random.below(8);
    return kind < kOdd.size() ? kOdd[kind] : static_cast<std::uint32_t>(random.bits());
}

/// Triangles about a point seen at a random pixel, some of no area, some edge-on, some across the world.
PixelBatch randomBatch(Random& random, const plan::View& view) {
    PixelBatch batch;
    batch.count = 1 + random.below(PixelBatch::kMaxPixels);
    for (std::size_t i = 0; i < batch.count; ++i) {
        batch.x[i] = static_cast<float>(random.below(static_cast<std::uint64_t>(view.width))) + 0.5F;
        batch.y[i] = static_cast<float>(random.below(static_cast<std::uint64_t>(view.height))) + 0.5F;
        const double size = std::exp2(random.uniform(0, 24));
        const bool hasArea = random.below(16) != 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto cells = [&](double reach) { return static_cast<std::int32_t>(random.uniform(-reach, reach)); };
            batch.corner[axis][i] = cells(0x1p24);
            batch.edge1[axis][i] = cells(size);
            const std::int32_t other = cells(size);
            batch.edge2[axis][i] = hasArea ? other : 2 * batch.edge1[axis][i];
        }
        for (std::size_t k = 0; k < 3; ++k) {
            batch.normals[k][i] = randomNormal(random);
            batch.colors[k][i] = static_cast<std::uint32_t>(random.bits());
        }
        batch.litMask[i] = static_cast<float>(random.below(256)) / 255.0F;
    }
    return batch;
}

TEST(ShadingTwin, RandomTrianglesUnderEveryScheme) {
    const Field field;
    const std::unique_ptr<Backend> backend = makeSoftwareBackend();
    std::size_t shadowed = 0;
    std::size_t partitions = 0;
    for (std::uint64_t seed = 1; seed <= 14; ++seed) {
        SCOPED_TRACE(seed);
        const plan::FramePlan plan = field.plan(field.view(seed), softwareQuality(seed));
        DrawInputs frame = field.drawing(plan);
        backend->draw(frame);
        const FloatPicture maps = backend->shadowDepth();
        const Raster<std::uint8_t> mask(kFieldSide, kFieldSide);
        if (seed % 9 == 0) frame.litMask = &mask;
        const Shading shading(frame, imageClipFromDraw(frame), maps, {});
        Random random(seed);
        for (int repetition = 0; repetition < 10; ++repetition) {
            PixelBatch plain = randomBatch(random, plan.view);
            plainShade(shading.frame(), plain);
            for (std::size_t i = 0; i < plain.count; ++i) {
                shadowed += plain.faces[i] != 0 && plain.lit[i] < 1 ? 1U : 0U;
                partitions |= plain.pass[i] < 0 ? 0U : std::size_t{1} << static_cast<unsigned>(plain.pass[i]);
            }
            onEveryTarget([&] {
                PixelBatch batch = plain;
                batch.color.fill(0);
                batch.lit.fill(-1);
                shadePixels(shading.frame(), batch);
                expectSame(batch, plain);
            });
        }
    }
    EXPECT_GT(shadowed, 200U);
    EXPECT_GT(partitions, 0xFFU) << "a map was never asked";
}

void expectSameFrame(Backend& found, Backend& expected) {
    EXPECT_EQ(found.picture().pixels, expected.picture().pixels);
    EXPECT_EQ(found.shadowDepth().pixels, expected.shadowDepth().pixels);
    EXPECT_EQ(found.viewDepth().pixels, expected.viewDepth().pixels);
    const auto a = found.surfaces().pixels;
    const auto b = expected.surfaces().pixels;
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(SurfaceSample)), 0);
}

void expectSameOnAnyThreads(const DrawInputs& frame, Backend& expected) {
    for (const int threads : {1, 2}) {
        const std::unique_ptr<Backend> backend = makeSoftwareBackend();
        tbb::task_arena(threads).execute([&] { backend->draw(frame); });
        expectSameFrame(*backend, expected);
    }
}

/// Pictures of the same frame on every instruction set and with one thread and two.
TEST(ShadingTwin, FramesAreTheSameEverywhere) {
    const Field field;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        const plan::FramePlan plan = field.plan(field.view(seed), softwareQuality(seed));
        DrawInputs frame = field.drawing(plan);
        frame.wantsSurfaces = true;
        frame.overlay = static_cast<Overlay>(seed % 8);
        const std::unique_ptr<Backend> expected = makeSoftwareBackend();
        expected->draw(frame);
        onEveryTarget([&] { expectSameOnAnyThreads(frame, *expected); });
    }
}

} // namespace
} // namespace gnomon::render
