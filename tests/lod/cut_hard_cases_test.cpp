// The hard cases of choosing a cut; docs/hard_cases.md shows this table.
#include "lod/error_rule.h"
#include "tests/support/hard_cases.h"

#include <array>
#include <cmath>

namespace gnomon::lod {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

DetailView straightView() {
    DetailView view;
    view.basis = cameraBasis(Camera{}); // looks along -z
    return view;
}

void zeroRadius() {
    const ErrorRule rule(straightView());
    const double pixels = rule.viewPixels({{0, 0, -10}, 0}, 0.01);
    EXPECT_NEAR(pixels, 0.01 * rule.view().pixelsPerUnit() / 10, 1e-9);
    EXPECT_TRUE(std::isfinite(rule.viewPixels({{0, 0, 0}, 0}, 0.01))); // the eye itself
}

void eyeOnSphere() {
    const ErrorRule rule(straightView());
    for (const double distance : {1.0, std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
        const double pixels = rule.viewPixels({{0, 0, -distance}, 1}, 0.01);
        EXPECT_TRUE(std::isfinite(pixels));
        // Nothing is nearer than nearestDepth, so nothing can be seen larger than that.
        EXPECT_GE(pixels, 0.01 * rule.view().pixelsPerUnit() / 1.0);
    }
}

void eyeInSphere() {
    const ErrorRule rule(straightView());
    const double inside = rule.viewPixels({{0, 0, -0.5}, 1}, 0.01);
    EXPECT_TRUE(std::isfinite(inside));
    EXPECT_GE(inside, rule.viewPixels({{0, 0, -1.5}, 0.4}, 0.01)); // a ball inside it that the eye is outside of
    EXPECT_GT(rule.viewPixels({{0, 0, 0.5}, 1}, 0.01), 0);         // even if its centre is behind the eye
}

void errorZero() {
    const ErrorRule rule(straightView());
    EXPECT_EQ(rule.pixels({{0, 0, -1}, 1}, 0), 0);
    EXPECT_FALSE(rule.exceeds({{0, 0, -1}, 1}, 0, 0));
    EXPECT_TRUE(rule.exceeds({{0, 0, -1}, 1}, 1e-300, 0)); // full detail: whatever has an error is refined
}

void rootError() {
    const ErrorRule rule(straightView());
    EXPECT_EQ(rule.pixels({{0, 0, 1e9}, 1}, kInfinity), kInfinity); // far behind the eye, too
    EXPECT_TRUE(rule.exceeds({{0, 0, 1e9}, 0}, kInfinity, 1e300));
}

void extremeExtents() {
    for (const double scale : {1e-6, 1e9}) {
        DetailView view = straightView();
        view.nearestDepth = 1e-6 * scale;
        const ErrorRule rule(view);
        const double pixels = rule.viewPixels({{0, 0, -10 * scale}, scale}, 0.01 * scale);
        EXPECT_NEAR(pixels, ErrorRule(straightView()).viewPixels({{0, 0, -10}, 1}, 0.01), 1e-6);
    }
}

constexpr std::array kCases = {
    HardCase{"bounds of radius zero", "a division by the radius, or by the distance of 0 at the eye", zeroRadius},
    HardCase{
        "the eye on a bounding sphere",
        "the distance to the sphere is 0, and the error in pixels is infinite",
        eyeOnSphere},
    HardCase{
        "the eye inside a bounding sphere",
        "a negative distance changes the sign, and geometry around the eye becomes coarse",
        eyeInSphere},
    HardCase{"error 0", "0 / 0, or a threshold of 0 that refines exact groups without end", errorZero},
    HardCase{"the infinite error of a root", "outside the view the error is infinity times 0, which is NaN", rootError},
    HardCase{
        "extents of 1e-6 and 1e9", "an absolute near distance contains the whole model, or nothing", extremeExtents},
};

TEST(CutHardCases, HoldAndAreInTheDocument) {
    runHardCases(GNOMON_SOURCE_DIR, "Choosing a cut", kCases);
}

} // namespace
} // namespace gnomon::lod
