// The single-precision path, as a GPU takes it, against double: how many texels of 4096 it is off.
#include "random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

constexpr double kTexels = 4096;

/// (s, t) in texels of 4096 by the float clip matrix of a map from a float position, as a setup's lookups go.
glm::dvec2 floatTexel(const glm::dmat4& textureFromCamera, const glm::dvec3& p) {
    glm::dmat4 clipFromTexture(2);
    clipFromTexture[3] = {-1, -1, -1, 1};
    const glm::vec4 at = glm::mat4(clipFromTexture * textureFromCamera) * glm::vec4(glm::vec3(p), 1.0F);
    const glm::vec2 unit = glm::vec2(at.x / at.w, at.y / at.w) * 0.5F + 0.5F;
    return glm::dvec2(unit) * kTexels;
}

glm::dvec2 doubleTexel(const WarpedMap& map, const glm::dvec3& p) {
    const MapPoint at = mapPoint(map, p);
    return {at.s * kTexels, at.t * kTexels};
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

TEST(Float, IsWithinAHundredthOfATexel) {
    double worst = 0;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random random(seed);
        ViewFrustum frustum;
        frustum.near = std::pow(10.0, random.uniform(-2, 2));
        const double logRatio = random.uniform(std::log(1.1), std::log(1e8));
        frustum.far = frustum.near * (random.below(4) == 0 ? 1.1 : std::exp(logRatio));
        frustum.halfFovYRadians = random.uniform(1, 85) * kPi / 180;
        frustum.aspect = 1;
        const WarpedMap map = randomMap(random, frustum, lightAt(random, randomGamma(random)));
        const glm::dmat4 matrix = textureFromCamera(map);
        for (int i = 0; i < 8; ++i) {
            // The eye may be 1e7 units from the origin of the world: only the difference in double reaches the float.
            const glm::dvec3 eye = randomDirection(random) * 1e7;
            const glm::dvec3 world = eye + randomPointIn(random, frustum);
            const glm::dvec3 p = world - eye;
            const double off = glm::length(floatTexel(matrix, p) - doubleTexel(map, p));
            worst = std::max(worst, off);
            ASSERT_LT(off, 0.01) << "seed " << seed << " ratio " << frustum.depthRatio() << " theta "
                                 << frustum.halfFovYRadians * 180 / kPi << " kappa d " << map.kappa * map.length;
        }
    }
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
        const WarpedMap map = randomMap(random, frustum, lightAt(random, randomGamma(random)));
        const glm::dvec3 origin(0, 0, (frustum.near + frustum.far) / 2);
        const glm::dmat4 matrix = relativeTo(textureFromCamera(map), origin);
        double extent = 0;
        for (const glm::dvec3& corner : corners(frustum))
            extent = std::max(extent, glm::length(corner - origin));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p = randomPointIn(random, frustum);
            const glm::dvec2 found = floatTexel(matrix, p - origin);
            ASSERT_TRUE(std::isfinite(found.x) && std::isfinite(found.y)) << "seed " << seed;
            const double off = glm::length(found - doubleTexel(map, p)) / kTexels;
            const double bound = condition(map, p, origin, extent) * 0x1.0p-22;
            worst = std::max(worst, off / bound);
            ASSERT_LE(off, bound) << "seed " << seed << " ratio - 1 " << frustum.depthRatio() - 1 << " theta "
                                  << frustum.halfFovYRadians * 180 / kPi;
        }
    }
    std::printf("worst %g of the bound\n", worst);
}

TEST(Float, TheTwoWaysToALookupAgree) {
    Random random(9);
    for (int round = 0; round < 500; ++round) {
        const ShadowView view = randomView(random);
        const ShadowMapSetup setup = shadowMapSetup(view, randomOptions(random, view.frustum));
        for (const ShadowMapPartition& map : setup.maps) {
            const glm::dvec4 p(map.region.vertices[0].position, 1);
            const glm::dvec4 clip = map.lightClipFromCamera * p;
            const glm::dvec4 texture = map.textureFromCamera * p;
            const glm::dvec2 byClip = glm::dvec2(clip) / clip.w * map.textureScale + map.textureOffset;
            EXPECT_NEAR(glm::length(byClip - glm::dvec2(texture) / texture.w), 0, 1e-9);
            EXPECT_NEAR(clip.z / clip.w, 2 * texture.z / texture.w - 1, 1e-8);
        }
    }
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
