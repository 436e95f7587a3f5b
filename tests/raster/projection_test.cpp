// From grid positions to pixels, against the same in doubles; what a vertex is outside of.
#include "raster/projection.h"
#include "tests/raster/scenes.h"

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gnomon::raster {
namespace {

constexpr PixelBox kProjectionViewport = {7, 5, 330, 281};

glm::dvec4 exactClip(const View& view, const std::array<std::uint32_t, 3>& position) {
    glm::dvec4 cell(1);
    for (int axis = 0; axis < 3; ++axis)
        cell[axis] = static_cast<double>(position[static_cast<std::size_t>(axis)]) - view.eyeCell[axis];
    return glm::dmat4(view.clipFromCell) * cell;
}

std::array<std::uint32_t, 3> randomPosition(Random& random) {
    const auto coordinate = [&](double pixels) {
        return static_cast<std::uint32_t>(kSceneCenter + std::llround(random.uniform(-100, 400) * pixels));
    };
    return {coordinate(kFlatPixel), coordinate(kFlatPixel), coordinate(4096)};
}

TEST(Projection, PixelsAreThoseOfTheMatrixInDoubles) {
    Random random(1);
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const View view = seed % 4 == 0 ? flatView(kProjectionViewport) : insideView(kProjectionViewport, seed);
        const Projection pass = projection(view, true);
        for (int i = 0; i < 200; ++i) {
            const std::array<std::uint32_t, 3> position = randomPosition(random);
            const glm::dvec4 exact = exactClip(view, position);
            const ClipPosition p = clipPosition(pass, position.data());
            const double reach = std::abs(exact.x) + std::abs(exact.y) + std::abs(exact.z) + std::abs(exact.w);
            EXPECT_NEAR(p.w, exact.w, 1e-5 * reach + 1e-2 * std::abs(exact.w));
            if (exact.w < 0.05 * reach || outsideBits(pass, p) != 0) continue; // no pixel, or one that rounding moves
            const SnappedVertex vertex = snapped(pass, p);
            // One pixel is a twentieth of a thousandth of the vertex's distance from the eye's cell, in floats.
            const double x = kProjectionViewport.x0 + (p.x / double{p.w} + 1) * kProjectionViewport.width() / 2 - 0.5;
            const double y = kProjectionViewport.y0 + (p.y / double{p.w} + 1) * kProjectionViewport.height() / 2 - 0.5;
            EXPECT_NEAR((vertex.x + double{restOf(vertex.restX)}) / kSubpixels, x, 1e-3);
            EXPECT_NEAR((vertex.y + double{restOf(vertex.restY)}) / kSubpixels, y, 1e-3);
            EXPECT_NEAR(vertex.z, p.z / double{p.w}, 1e-6);
            ++compared;
        }
    }
    EXPECT_GT(compared, 500);
}

TEST(Projection, ThePixelCentresOfTheCornersLieHalfAPixelInside) {
    const Projection pass = projection(flatView(kProjectionViewport), false);
    const auto at = [&](float x, float y) { return snapped(pass, {x, y, 0, 1}); };
    EXPECT_EQ(at(-1, -1).x, 7 * kSubpixels - kSubpixels / 2) << "centres at whole pixels";
    EXPECT_EQ(at(-1, -1).y, 5 * kSubpixels - kSubpixels / 2);
    EXPECT_EQ(at(1, 1).x, 330 * kSubpixels - kSubpixels / 2);
    EXPECT_EQ(at(1, 1).y, 281 * kSubpixels - kSubpixels / 2);
    const SnappedVertex scaled = snapped(pass, {2, -2, 1, 4});
    EXPECT_EQ(scaled.x, at(0.5F, -0.5F).x) << "divided by w";
    EXPECT_EQ(scaled.y, at(0.5F, -0.5F).y);
    EXPECT_EQ(scaled.z, 0.25F);
}

TEST(Projection, DepthIsHeldFiniteAndHasNoNegativeZero) {
    const Projection pass = projection(flatView(kProjectionViewport), false);
    EXPECT_EQ(snapped(pass, {0, 0, 1e30F, 1e-5F}).z, kDepthLimit);
    EXPECT_EQ(snapped(pass, {0, 0, -1e30F, 1e-5F}).z, -kDepthLimit);
    EXPECT_FALSE(std::signbit(snapped(pass, {0, 0, -0.0F, 1}).z));
    EXPECT_EQ(snapped(pass, {0, 0, 0.5F, 2}).z, 0.25F);
}

TEST(Projection, SnappingKeepsWhatItCutsOff) {
    Random random(2);
    for (int i = 0; i < 10000; ++i) {
        const double x = random.uniform(-1e6, 1e6);
        const double y = random.uniform(-1e6, 1e6);
        const SnappedVertex vertex = snappedTo(x, y, 0.5F);
        EXPECT_LE(std::abs(vertex.x - x), 0.5);
        EXPECT_LE(std::abs(vertex.y - y), 0.5);
        EXPECT_NEAR(vertex.x + double{restOf(vertex.restX)}, x, 1.0 / (1 << kRestBits));
        EXPECT_NEAR(vertex.y + double{restOf(vertex.restY)}, y, 1.0 / (1 << kRestBits));
        EXPECT_EQ(vertex.z, 0.5F);
    }
    EXPECT_EQ(snappedTo(0.5, 0, 0).x, 0) << "half to even";
    EXPECT_EQ(snappedTo(0.5, 0, 0).restX, 32767) << "half upwards is more than the rest holds, by the least step";
    EXPECT_EQ(snappedTo(1.5, 0, 0).x, 2);
    EXPECT_EQ(snappedTo(1.5, 0, 0).restX, -32768);
    EXPECT_EQ(restOf(-32768), -0.5F);
}

TEST(Projection, EachPlaneHasItsBitAndThePlaneItselfIsInside) {
    const Projection plain = projection(flatView(kProjectionViewport), false);
    const Projection cut = projection(flatView(kProjectionViewport), true);

    struct Case {
        ClipPosition p;
        std::uint32_t sides = 0;
        std::uint32_t depths = 0;
    };

    constexpr float kNext = 2.0000002F;
    for (const Case& c :
         {Case{{0, 0, 1, 2}, 0, 0},
          Case{{-2, 2, 0, 2}, 0, 0},
          Case{{2, -2, 2, 2}, 0, 0},
          Case{{-kNext, 0, 1, 2}, 1, 0},
          Case{{kNext, 0, 1, 2}, 2, 0},
          Case{{0, -kNext, 1, 2}, 4, 0},
          Case{{0, kNext, 1, 2}, 8, 0},
          Case{{0, 0, kNext, 2}, 0, 16},
          Case{{0, 0, -1e-30F, 2}, 0, 32},
          Case{{0, 0, -1, -1}, 1 | 2 | 4 | 8, 32},
          Case{{5, 5, 5, 2}, 2 | 8, 16}}) {
        EXPECT_EQ(outsideBits(plain, c.p), c.sides) << c.p.x << ' ' << c.p.y << ' ' << c.p.z << ' ' << c.p.w;
        EXPECT_EQ(outsideBits(cut, c.p), c.sides | c.depths) << c.p.x << ' ' << c.p.y << ' ' << c.p.z << ' ' << c.p.w;
    }
}

TEST(Projection, TheGuardIsAPowerOfTwoAndReachesThirtyThousandPixels) {
    for (const int side : {1, 2, 3, 100, 255, 256, 257, 2048, 16384}) {
        const Projection pass = projection(flatView({0, 0, side, 2 * side}), false);
        EXPECT_EQ(std::exp2(std::round(std::log2(pass.guardX))), pass.guardX);
        EXPECT_LE(pass.guardX * static_cast<float>(side) / 2, kGuardPixels);
        EXPECT_GT(pass.guardX * static_cast<float>(side), kGuardPixels) << "the largest such power";
        EXPECT_EQ(pass.guardY, pass.guardX / 2);
    }
    EXPECT_GE(projection(flatView({0, 0, kMaxTargetSide, 1}), false).guardX, 1)
        << "no viewport is cut by its own guard";
}

TEST(VisibilityWord, TheNearestIsTheLargestAndTheLeastNameWinsATie) {
    Random random(3);
    for (int i = 0; i < 10000; ++i) {
        const auto a = static_cast<float>(random.unit());
        const auto b = random.below(4) == 0 ? a : static_cast<float>(random.unit());
        const auto idA = static_cast<std::uint32_t>(random.bits());
        const auto idB = static_cast<std::uint32_t>(random.bits());
        const std::uint64_t wordA = visibilityWord(a, idA);
        EXPECT_EQ(visibleDepth(wordA), a);
        EXPECT_EQ(visibleTriangle(wordA), idA);
        const bool isNearer = a > b || (a == b && idA < idB);
        EXPECT_EQ(wordA > visibilityWord(b, idB), isNearer);
    }
    EXPECT_NE(visibilityWord(0, 0), 0U) << "a triangle at the far end is there";
}

TEST(PixelBox, IsEmptyWithoutAWidthOrAHeight) {
    EXPECT_FALSE((PixelBox{0, 0, 1, 1}.empty()));
    EXPECT_TRUE((PixelBox{0, 0, 0, 1}.empty()));
    EXPECT_TRUE((PixelBox{0, 0, 1, 0}.empty()));
    EXPECT_TRUE((PixelBox{3, 0, 2, 5}.empty()));
    EXPECT_TRUE((PixelBox{0, 3, 5, 2}.empty()));
    EXPECT_EQ((PixelBox{2, 3, 7, 9}.width()), 5);
    EXPECT_EQ((PixelBox{2, 3, 7, 9}.height()), 6);
}

} // namespace
} // namespace gnomon::raster
