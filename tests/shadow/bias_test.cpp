// The depth bias: enough for the receiver's own plane, no more than that and its uneven neighbours ask for, and with
// room in the map's depth.
#include "measured_map.h"
#include "shadow/depth_bias.h"
#include "shadow/map_image.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

std::optional<Receiver> randomReceiver(Random& random, double minCosine) {
    const ShadowView view = randomView(random);
    const ShadowOptions options = randomOptions(random, view.frustum);
    const ShadowMapSetup setup = shadowMapSetup(view, options);
    Receiver result;
    result.map = setup.maps[random.below(setup.maps.size())];
    result.filterTexels = options.filterTexels;
    if (result.map.warped.kappa * result.map.warped.length > 1e4) return std::nullopt;
    result.p = result.map.region.vertices[random.below(result.map.region.vertices.size())].position;
    result.normal = randomDirection(random);
    result.cosine = glm::dot(result.normal, view.towardsLight);
    if (result.cosine < minCosine) return std::nullopt;
    return result;
}

TEST(Bias, ReachesTheMiddleOfEveryTexelThatAKernelReads) {
    // A kernel of w texels from floor(x - (w - 1) / 2) on: its middles lie at most w / 2 from x.
    for (const int width : {1, 2, 3, 4, 5, 8}) {
        double furthest = 0;
        for (double x = 0; x < 1; x += 1.0 / 64)
            for (int i = 0; i < width; ++i)
                furthest = std::max(furthest, std::abs(std::floor(x - 0.5 * (width - 1)) + i + 0.5 - x));
        EXPECT_GE(reachTexels(width), furthest);
        EXPECT_LE(reachTexels(width), furthest + 1.0 / 128);
    }
    EXPECT_EQ(reachTexels(0), reachTexels(1));
}

TEST(Bias, IsWhatTheReceiversOwnPlaneAsksForAndItsUnevenNeighbours) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        const std::optional<Receiver> receiver = randomReceiver(random, kMinCosine);
        if (!receiver) continue;
        ++tested;
        const double bias = receiver->bias();
        const double rise = largestRise(*receiver);
        EXPECT_GE(bias, rise * (1 - 1e-6)) << "seed " << seed;
        const DoubleMapImage image = cameraImage(receiver->map);
        const double w = texelAt(image, receiver->p).w;
        const bool isLog = image.logRows != 0;
        const double uneven = std::hypot(image.unevenX, image.unevenZ * (isLog ? 1 : w)) * image.reach;
        // Logarithmic rows grow over the reach, and the plane may rise along their shorter side.
        const double growth = isLog ? std::exp(2 * image.reach / image.texelScale.y) : 1;
        constexpr double kInverse = 1e-8; // what inverting the matrix loses
        const double further =
            std::max(1.0, image.reach / reachTexels(receiver->map.filterTexels)); // where floats miss
        EXPECT_LE(bias, rise * growth * further * (1 + 2.0 / 256) * (1 + 1e-6) + uneven + kDepthRounding + kInverse)
            << "seed " << seed;
    }
    EXPECT_GT(tested, 1000);
}

/// What the unevenness stands for: a neighbour that rises kUnevenSlope over the reach in the map's x or z.
TEST(Bias, UnevennessIsItsSlopeOverATexel) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const std::optional<Receiver> receiver = randomReceiver(random, kMinCosine);
        if (!receiver) continue;
        const ShadowMap& map = receiver->map;
        const DoubleMapImage image = cameraImage(map);
        const LightBeam texel = lightBeam(map.warped, receiver->p, map.texels());
        const double w = texelAt(image, receiver->p).w;
        // Along the light alone, depth changes by 1 / (w range) a unit.
        const double perUnit = 1 / (w * map.warped.rawRange);
        const double scaled = image.logRows == 0 ? 1 : w / mapPoint(map.warped, receiver->p).w;
        EXPECT_NEAR(image.unevenX / (kUnevenSlope * texel.x * perUnit * scaled), 1, 1e-9);
        if (image.logRows == 0) {
            EXPECT_NEAR(image.unevenZ * w / (kUnevenSlope * texel.z * perUnit), 1, 1e-9);
            continue;
        }
        // Over the reach the rows further on are longer.
        const double steps = image.reach / image.texelScale.y;
        const double wOfMap = mapPoint(map.warped, receiver->p).w;
        const double longer = std::expm1(steps) / steps;
        EXPECT_NEAR(image.unevenZ * wOfMap * map.warped.rawRange / (kUnevenSlope * texel.z * longer), 1, 1e-9);
    }
}

TEST(Bias, IsContinuousAndBoundedAsTheReceiverTurnsEdgeOn) {
    const ShadowMapSetup setup = shadowMapSetup({}, {});
    const ShadowMap& map = setup.maps[1];
    const LightFrame& frame = map.warped.frame;
    const DoubleMapImage image = cameraImage(map);
    const glm::dvec3 p(0.1, 0.2, (map.region.frustum.near + map.region.frustum.far) / 2);
    const auto at = [&](double cosine) {
        return receiverBias(image, p, frame.x * std::sqrt(1 - cosine * cosine) + frame.y * cosine, cosine);
    };
    EXPECT_NEAR(at(kMinCosine - 1e-9) / at(kMinCosine + 1e-9), 1, 1e-6);
    for (double cosine = 1e-9; cosine < 1; cosine *= 1.3)
        EXPECT_LE(at(cosine), at(kMinCosine) * 1.02) << cosine;
    EXPECT_GE(at(1e-9), at(kMinCosine));
}

TEST(Bias, TheDepthRangeHasRoomForItAndLittleMore) {
    double minRoom = 1;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const std::optional<Receiver> receiver = randomReceiver(random, 1e-3);
        if (!receiver) continue;
        const double depth = mapPoint(receiver->map.warped, receiver->p).depth;
        const double bias = receiver->bias();
        EXPECT_GE(depth - bias, -1e-6) << "seed " << seed;
        if (!receiver->map.stable && depth < 0.5) minRoom = std::min(minRoom, (depth - bias) / depth);
    }
    EXPECT_LT(minRoom, 0.5) << "the range is grown by more than twice the largest bias";
}

TEST(Bias, NeverAsksForMoreThanHalfOfTheRange) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random random(seed);
        const std::optional<Receiver> receiver = randomReceiver(random, 1e-3);
        if (!receiver) continue;
        EXPECT_LE(receiver->bias(), 0.5 + kDepthRounding) << "seed " << seed;
    }
}

} // namespace
} // namespace gnomon::shadow
