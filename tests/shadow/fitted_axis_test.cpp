// Rows fitted to a view: that they are monotone and can be inverted, and what a slow walk does to them.
#include "random_samples.h"
#include "shadow/setup.h"
#include "shadow/warp/fitted_axis.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace gnomon::shadow {
namespace {

FittedAxis randomRows(Random& random) {
    FittedAxis::Densities densities{};
    for (double& density : densities)
        density = std::pow(10.0, random.uniform(-1.2, 0.9));
    const double low = static_cast<double>(random.below(7)) / 8;
    return {low, low + static_cast<double>(1 + random.below(8 - static_cast<std::uint64_t>(low * 8))) / 8, densities};
}

TEST(FittedAxis, GoFromZeroToOneStrictlyUpAndBack) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const FittedAxis rows = randomRows(random);
        ASSERT_NEAR(rows.at(rows.low()), 0, 1e-12);
        ASSERT_NEAR(rows.at(rows.high()), 1, 1e-12);
        double before = rows.at(-0.25);
        for (int i = 1; i <= 600; ++i) {
            const double t = -0.25 + 1.5 * i / 600;
            const double row = rows.at(t);
            ASSERT_GT(row, before) << seed << " " << t;
            ASSERT_NEAR(rows.inverse(row), t, 1e-9) << seed;
            before = row;
        }
    }
}

TEST(FittedAxis, HaveTheDensityOfTheirDifferences) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const FittedAxis rows = randomRows(random);
        double least = 1e9;
        double most = 0;
        double covered = 0;
        for (std::size_t i = 0; i < kFittedParts; ++i) {
            const double width = (rows.high() - rows.low()) / kFittedParts;
            const double middle = rows.low() + (static_cast<double>(i) + 0.5) * width;
            const double h = 0.25 * width;
            const double slope = (rows.at(middle + h) - rows.at(middle - h)) / (2 * h);
            ASSERT_NEAR(rows.density(middle) / slope, 1, 1e-9) << seed;
            ASSERT_EQ(rows.density(middle), rows.ofPart(i));
            least = std::min(least, slope);
            most = std::max(most, slope);
            covered += slope * width;
            ASSERT_NEAR(rows.start(i), rows.at(middle - 2 * h), 1e-9);
        }
        ASSERT_NEAR(covered, 1, 1e-9);
        ASSERT_NEAR(rows.leastDensity() / least, 1, 1e-9);
        ASSERT_NEAR(rows.greatestDensity() / most, 1, 1e-9);
    }
}

TEST(FittedAxis, WithoutDensitiesAreThoseOfTheMap) {
    const FittedAxis even;
    for (const double t : {-0.3, 0.0, 0.2, 0.77, 1.0, 1.4}) {
        EXPECT_NEAR(even.at(t), t, 1e-12);
        EXPECT_NEAR(even.inverse(t), t, 1e-12);
        EXPECT_NEAR(even.density(t), 1, 1e-12);
    }
    EXPECT_TRUE(
        even == FittedAxis(
                    0,
                    1,
                    [] {
                        FittedAxis::Densities densities{};
                        densities.fill(5);
                        return densities;
                    }()))
        << "only proportions count";
}

/// What fits did on a walk through fixed surfaces.
struct Walked {
    int changes = 0;              // frames whose rows or columns are not those of the one before
    double worstAgainstFresh = 0; // what is promised over what a fit to the frame alone promises
    double worstAgainstLog = 0;   // and over what logarithmic rows promise of the frame
    double meanAgainstLog = 0;
};

/// What is seen: a few surfaces, far less than what is promised for, or all of the frustum.
enum class Shown : std::uint8_t { Little, Most, All };

std::vector<glm::dvec3> surfaces(Random& random, Shown shown) {
    std::vector<glm::dvec3> world;
    for (int i = 0; i < 4000; ++i) { // a ground, and some walls on it
        const double depth = shown == Shown::Little
                                 ? random.uniform(6, 20)
                                 : std::pow(10.0, random.uniform(shown == Shown::Most ? 0.3 : -0.2, 2.5));
        const double aside = random.uniform(-1, 1) * (shown == Shown::Little ? 1.5 : depth);
        world.emplace_back(
            i % 3 == 0 ? 5 * std::round(aside / 5) : aside, i % 3 == 0 ? random.uniform(-2, 6) : -2, depth);
    }
    return world;
}

/// What of `world` is seen from `forward` along the view.
std::shared_ptr<const std::vector<glm::vec3>> seen(
    const std::vector<glm::dvec3>& world, const ViewFrustum& frustum, double forward) {
    std::vector<glm::vec3> samples;
    for (const glm::dvec3& p : world) {
        const glm::dvec3 q = p - glm::dvec3(0, 0, forward);
        const double most = q.z * tanHalfY(frustum);
        const bool isSeen = q.z >= frustum.near && std::abs(q.x) <= most && std::abs(q.y) <= most;
        if (isSeen) samples.emplace_back(q);
    }
    return std::make_shared<const std::vector<glm::vec3>>(std::move(samples));
}

Walked walked(std::uint64_t seed, int frames, Shown shown) {
    Random random(seed);
    ShadowView view;
    view.frustum = {0.5, 500, 0.4, 1};
    view.towardsLight = glm::normalize(glm::dvec3(0.3, 1, random.uniform(-0.6, 0.6)));
    const std::vector<glm::dvec3> world = surfaces(random, shown);
    ShadowOptions options;
    options.scheme.warp.rule = WarpRule::Fitted;
    options.scheme.slices = 1;
    options.chosenOrientation = false;
    Walked result;
    std::vector<MapFit> before;
    for (int frame = 0; frame < frames; ++frame) {
        view.samples = seen(world, view.frustum, frame * 0.02);
        view.fitsBefore = before;
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        view.fitsBefore.clear();
        const double fresh = shadowMapSetup(view, options).worst().worst();
        ShadowOptions unfitted = options;
        unfitted.scheme.warp.rule = WarpRule::Log;
        const double log = shadowMapSetup(view, unfitted).worst().worst();
        result.worstAgainstLog = std::max(result.worstAgainstLog, setup.worst().worst() / log);
        result.meanAgainstLog += setup.worst().worst() / log / frames;
        result.worstAgainstFresh = std::max(result.worstAgainstFresh, setup.worst().worst() / fresh);
        const bool isMoved =
            frame > 0 && (setup.fits[0].rows != before[0].rows || setup.fits[0].columns != before[0].columns);
        result.changes += isMoved ? 1 : 0;
        before = setup.fits;
    }
    return result;
}

TEST(FittedMaps, StayOnASlowWalkUntilTheyAreWorthMoving) {
    constexpr int kFrames = 60;
    constexpr int kWalks = 8;
    for (const Shown shown : {Shown::Little, Shown::Most, Shown::All}) {
        SCOPED_TRACE(static_cast<int>(shown));
        Walked all;
        for (std::uint64_t seed = 0; seed < kWalks; ++seed) {
            const Walked walk = walked(seed, kFrames, shown);
            all.changes += walk.changes;
            all.worstAgainstFresh = std::max(all.worstAgainstFresh, walk.worstAgainstFresh);
            all.worstAgainstLog = std::max(all.worstAgainstLog, walk.worstAgainstLog);
            all.meanAgainstLog += walk.meanAgainstLog / kWalks;
        }
        std::printf(
            "%d changes in %d frames, at most %g of a fresh fit's promise; of logarithmic rows' %g, mean %g\n",
            all.changes,
            kWalks * kFrames,
            all.worstAgainstFresh,
            all.worstAgainstLog,
            all.meanAgainstLog);
        EXPECT_LE(all.changes, kWalks * kFrames / 10);
        EXPECT_LE(all.worstAgainstFresh, kRefit * 1.05);
        EXPECT_LE(all.worstAgainstLog, 1.01) << "but for what whole texels cost";
        if (shown != Shown::Little) continue;
        EXPECT_GT(all.changes, kWalks) << "a fit that never moves is none";
        EXPECT_LT(all.meanAgainstLog, 0.6) << "nor is one that gains nothing";
    }
}

} // namespace
} // namespace gnomon::shadow
