// The single-precision path, as a GPU takes it, against double: how many texels of 4096 it is off.
#include "shadow/map_image.h"
#include "shadow/shadow_map.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

constexpr int kTexels = 4096;

/// A map of 4096 x 4096 texels with a gutter of one.
ShadowMap mapOf(const WarpedMap& warped) {
    ShadowMap map;
    map.warped = warped;
    map.rectangle = {0, 0, kTexels + 2, kTexels + 2, false};
    return map;
}

/// How many texels of 4096 the image in single precision is off at `p`, where positions are floats relative to
/// `origin`.
double texelsOff(const ShadowMap& map, const glm::dvec3& origin, const glm::dvec3& p) {
    const FloatMapImage image = rounded(mapImage(map, relativeTo(map.lightClipFromCamera(), origin), glm::dvec3(0)));
    const MapTexel<float> found = texelAt(image, glm::vec3(p - origin));
    return glm::length(glm::dvec2(found.column, found.row) - exactTexel(map, p));
}

glm::dvec3 lightAt(Random& random, double gammaRadians) {
    const double turn = random.uniform(0, 2 * kPi);
    const glm::dvec3 across(std::cos(turn), std::sin(turn), 0);
    const double sign = random.below(2) == 0 ? 1 : -1;
    return glm::normalize(across * std::sin(gammaRadians) + glm::dvec3(0, 0, sign * std::cos(gammaRadians)));
}

/// From 0 in steps of 1e-12, then through every power of ten up to a right angle.
double randomGamma(Random& random) {
    const std::uint64_t kind = random.below(3);
    if (kind == 0) return 1e-12 * static_cast<double>(random.below(50));
    if (kind == 1) return std::pow(10.0, random.uniform(-12, 0));
    return random.uniform(0, kPi / 2);
}

/// The map of a warp of this project over a whole slice. Wimmer's rule warps tilted wide views so hard that positions
/// alone cost up to 0.014 texels.
WarpedMap randomMap(Random& random, const ViewFrustum& frustum, const glm::dvec3& light) {
    Warp warp;
    warp.rule = std::array<WarpRule, 3>{WarpRule::None, WarpRule::Minimax, WarpRule::Auto}[random.below(3)];
    const LightFrame frame = random.below(2) == 0 ? lightFrame(light) : chosenFrame(frustum, light, warp, std::nullopt);
    const LightFit fit = fitSlice(frame, frustum);
    return warpedMap(fit, kappaOf(warp, fit));
}

/// In about two points in a million, terms a hundred times as large as w cancel, and float sums lose some more.
TEST(Float, IsWithinAHundredthOfATexelButForAFewPointsInAMillion) {
    double worst = 0;
    int exceeding = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        ViewFrustum frustum;
        frustum.near = std::pow(10.0, random.uniform(-2, 2));
        const double logRatio = random.uniform(std::log(1.1), std::log(1e8));
        frustum.far = frustum.near * (random.below(4) == 0 ? 1.1 : std::exp(logRatio));
        frustum.halfFovYRadians = random.uniform(1, 85) * kPi / 180;
        frustum.aspect = 1;
        const ShadowMap map = mapOf(randomMap(random, frustum, lightAt(random, randomGamma(random))));
        for (int i = 0; i < 8; ++i) {
            // The eye may be 1e7 units from the origin of the world: only the difference in double reaches the float.
            const glm::dvec3 eye = randomDirection(random) * 1e7;
            const glm::dvec3 world = eye + randomPointIn(random, frustum);
            const glm::dvec3 p = world - eye;
            const double off = texelsOff(map, glm::dvec3(0), p);
            worst = std::max(worst, off);
            exceeding += off < 0.01 ? 0 : 1;
            ASSERT_LT(off, 0.04) << "seed " << seed << " ratio " << frustum.depthRatio() << " theta "
                                 << frustum.halfFovYRadians * 180 / kPi << " kappa d "
                                 << map.warped.kappa * map.warped.length;
        }
    }
    EXPECT_LE(exceeding, 2) << "of 160000";
    RecordProperty("worst_texels_of_4096", std::to_string(worst));
    std::printf("worst %g texels of 4096\n", worst);
}

/// The largest factor by which an error of the size of the largest coordinate can grow: the map's gradient, times the
/// extent of the region relative to its origin.
double condition(const WarpedMap& map, const glm::dvec3& p, const glm::dvec3& origin, double extent) {
    const MapJacobian j = mapJacobian(map, p);
    const double size = std::max(extent, glm::length(p - origin));
    return (glm::length(j.s) + glm::length(j.t)) * size + 2;
}

TEST(Float, ThinViewsHoldRelativeToAPointInTheSlice) {
    double worst = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        ViewFrustum frustum;
        frustum.near = std::pow(10.0, random.uniform(-2, 2));
        frustum.far = frustum.near * (1 + std::pow(10.0, random.uniform(-6, -1)));
        frustum.halfFovYRadians = std::pow(10.0, random.uniform(std::log10(0.005), 1.5)) * kPi / 180;
        const ShadowMap map = mapOf(randomMap(random, frustum, lightAt(random, randomGamma(random))));
        const glm::dvec3 origin(0, 0, (frustum.near + frustum.far) / 2);
        double extent = 0;
        for (const glm::dvec3& corner : corners(frustum))
            extent = std::max(extent, glm::length(corner - origin));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p = randomPointIn(random, frustum);
            const double off = texelsOff(map, origin, p) / kTexels;
            ASSERT_TRUE(std::isfinite(off)) << "seed " << seed;
            const double bound = condition(map.warped, p, origin, extent) * 0x1.0p-22;
            worst = std::max(worst, off / bound);
            ASSERT_LE(off, bound) << "seed " << seed << " ratio - 1 " << frustum.depthRatio() - 1 << " theta "
                                  << frustum.halfFovYRadians * 180 / kPi;
        }
    }
    std::printf("worst %g of the bound\n", worst);
}

/// Shared with the rasteriser: what is drawn to a texel's middle is looked up there.
TEST(Float, TheImageIsTheMapToTheLastTexelOfItsRectangle) {
    Random random(9);
    for (int round = 0; round < 500; ++round) {
        const ShadowView view = randomView(random);
        const ShadowMapSetup setup = shadowMapSetup(view, randomOptions(random, view.frustum));
        for (const ShadowMap& map : setup.maps) {
            const DoubleMapImage image = cameraImage(map);
            for (const FitVertex& vertex : map.region.vertices) {
                const MapTexel<double> at = texelAt(image, vertex.position);
                EXPECT_NEAR(glm::length(glm::dvec2(at.column, at.row) - exactTexel(map, vertex.position)), 0, 1e-5);
                EXPECT_NEAR(at.depth, mapPoint(map.warped, vertex.position).depth, 1e-8);
            }
            // Clip space from -1 to 1 is the rectangle, gutters included: the viewport that casters are drawn with.
            EXPECT_EQ(image.texelOffset.x - image.texelScale.x, map.rectangle.x);
            EXPECT_EQ(2.0 * image.texelScale.x, map.rectangle.width);
            if (image.logRows == 0) {
                EXPECT_EQ(image.texelOffset.y - image.texelScale.y, map.rectangle.y);
                EXPECT_EQ(2.0 * image.texelScale.y, map.rectangle.height);
                EXPECT_TRUE(rowPositions(rounded(image), map.rectangle.y, map.rectangle.height).empty());
                continue;
            }
            // Logarithmic rows: casters are drawn where a lookup of theirs would read the middle of a row.
            const std::vector<float> rows = rowPositions(rounded(image), map.rectangle.y, map.rectangle.height);
            const glm::dvec4 clip =
                image.clipFromOffset * glm::dvec4(map.region.vertices[0].position - image.origin, 1);
            EXPECT_NEAR(clip.y, -1, 1e-9);
            for (std::size_t i = 0; i < rows.size(); i += 7) {
                const double read = std::log(-1 / rows[i]) * image.texelScale.y + image.texelOffset.y;
                EXPECT_NEAR(read, map.rectangle.y + static_cast<double>(i) + 0.5, 1e-2);
                EXPECT_GT(rows[i], -1);
            }
        }
    }
}

/// What an backend reads in single precision has the bias of the one in double, to a part in a thousand.
TEST(Float, TheBiasIsThatOfTheMapInDouble) {
    Random random(10);
    int tested = 0;
    for (int round = 0; round < 2000; ++round) {
        ShadowView view = randomView(random);
        view.frustum.far = view.frustum.near * random.uniform(1.2, 1e3);
        ShadowOptions options = randomOptions(random, view.frustum);
        options.scheme.warp.rule = WarpRule::Auto;
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        const ShadowMap& map = setup.maps[random.below(setup.maps.size())];
        const glm::dvec3 normal = randomDirection(random);
        const double cosine = glm::dot(normal, view.towardsLight);
        if (!(cosine > 0.01)) continue;
        const glm::dvec3 p = randomPointIn(random, map.region.frustum);
        const double exact = receiverBias(cameraImage(map), p, normal, cosine);
        const float found =
            receiverBias(rounded(cameraImage(map)), glm::vec3(p), glm::vec3(normal), static_cast<float>(cosine));
        EXPECT_NEAR(found, exact, 1e-3 * exact + 1e-7) << round;
        ++tested;
    }
    EXPECT_GT(tested, 500);
}

TEST(Float, ASetupGivesThinViewsAnOriginAndNoOthers) {
    ShadowView view;
    EXPECT_EQ(shadowMapSetup(view, {}).maps[0].origin, glm::dvec3(0));
    view.frustum.far = view.frustum.near * 1.05;
    const ShadowMapSetup thin = shadowMapSetup(view, {});
    EXPECT_GT(thin.maps[0].origin.z, view.frustum.near);
    EXPECT_LT(thin.maps[0].origin.z, view.frustum.far);
}

} // namespace
} // namespace gnomon::shadow
