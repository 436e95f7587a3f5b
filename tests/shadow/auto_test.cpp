// `auto`: never worse than no warp nor than minimax, and continuous as the light turns, orientation included.
#include "core/angle.h"
#include "shadow/setup.h"
#include "shadow/warp/orientation.h"
#include "shadow/warp/warp.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

const std::vector<ViewFrustum> kFrusta{
    {1, 5.62, 20 * kPi / 180, 1},
    {1, 1000, 20 * kPi / 180, 1},
    {1, 31.6, 35 * kPi / 180, 1.7778},
    {1, 2, 15 * kPi / 180, 1},
    {0.1, 20, 45 * kPi / 180, 0.6}};

constexpr double kTurn = 0.06 * kPi / 180;

double logGrowth(const LightFit& fit) {
    return std::log1p(kappaAuto(fit) * fit.length);
}

void expectNeverWorse(const LightFit& fit) {
    const double found = storageFactor(fit, kappaAuto(fit));
    ASSERT_LE(found, storageFactor(fit, 0) * (1 + 1e-12));
    ASSERT_LE(found, storageFactor(fit, kappaMinimax(fit)) * (1 + 1e-12));
}

void checkDirection(Random& random, const ViewFrustum& frustum) {
    const glm::dvec3 light = randomLight(random);
    const Warp warp;
    expectNeverWorse(fitSlice(lightFrame(light), frustum));
    const LightFit plain = fitSlice(lightFrame(light), frustum);
    const LightFrame chosen = chosenFrame(frustum, light, warp, std::nullopt);
    const LightFit fit = fitSlice(chosen, frustum);
    expectNeverWorse(fit);
    // The chosen orientation is never worse than anything in the plain one.
    const double found = storageFactor(fit, kappaAuto(fit));
    ASSERT_LE(found, std::min(storageFactor(plain, 0), storageFactor(plain, kappaMinimax(plain))) * (1 + 1e-9));

    const glm::dvec3 turnedLight = directionNear(random, light, kTurn);
    const OrientationState state{light, chosen.z};
    const LightFit next = fitSlice(chosenFrame(frustum, turnedLight, warp, state), frustum);
    ASSERT_LT(std::abs(logGrowth(next) - logGrowth(fit)), 0.2)
        << light.x << " " << light.y << " " << light.z << " ratio " << frustum.depthRatio();
    const double turn = std::acos(std::clamp(glm::dot(carried(state, turnedLight), next.frame.z), -1.0, 1.0));
    ASSERT_LT(turn * 180 / kPi, 3) << light.x << " " << light.y << " " << light.z;
}

TEST(Auto, IsNeverWorseAndTurnsWithTheLight) {
    Random random(1);
    for (int i = 0; i < 2000 && !HasFatalFailure(); ++i)
        checkDirection(random, kFrusta[random.below(kFrusta.size())]);
}

TEST(SlowAuto, IsNeverWorseAndTurnsWithTheLight) {
    Random random(2);
    for (const ViewFrustum& frustum : kFrusta)
        for (int i = 0; i < 100000 && !HasFatalFailure(); ++i)
            checkDirection(random, frustum);
}

TEST(Auto, ThePlainConventionIsContinuousWhereItDoesNotSpin) {
    Random random(3);
    for (int i = 0; i < 20000; ++i) {
        const ViewFrustum& frustum = kFrusta[random.below(kFrusta.size())];
        const glm::dvec3 light = randomDirection(random);
        if (sinLightAngle(light) < 0.05) continue;
        const LightFit a = fitSlice(lightFrame(light), frustum);
        const LightFit b = fitSlice(lightFrame(directionNear(random, light, kTurn)), frustum);
        EXPECT_LT(std::abs(logGrowth(a) - logGrowth(b)), 0.2);
    }
}

/// A long turn of the light, straight through the view direction and across the diagonals: the state follows all along,
/// and lagging behind the best orientation never costs more than twice the storage.
TEST(Auto, ALongTurnNeitherPopsNorFallsBehind) {
    for (const ViewFrustum& frustum : kFrusta) {
        Random random(4);
        for (int path = 0; path < 6; ++path) {
            const glm::dvec3 axis = randomDirection(random);
            glm::dvec3 light = path < 2 ? glm::dvec3(0, std::sin(0.5), -std::cos(0.5)) : randomDirection(random);
            // The first goes straight through the view direction, the second around it, across the diagonals.
            const glm::dvec3 turnAxis = path == 0 ? glm::dvec3(1, 0, 0) : path == 1 ? glm::dvec3(0, 0, 1) : axis;
            const Warp warp;
            OrientationState state{light, chosenFrame(frustum, light, warp, std::nullopt).z};
            double growth = logGrowth(fitSlice(lightFrameAlong(light, state.zAxis), frustum));
            for (int step = 0; step < 1500; ++step) {
                light = glm::normalize(light + glm::cross(turnAxis, light) * kTurn);
                const LightFit fit = fitSlice(chosenFrame(frustum, light, warp, state), frustum);
                const double cosine = std::clamp(glm::dot(carried(state, light), fit.frame.z), -1.0, 1.0);
                ASSERT_LT(std::acos(cosine) * 180 / kPi, 3) << "path " << path << " step " << step;
                state = {light, fit.frame.z};
                const double now = logGrowth(fit);
                ASSERT_LT(std::abs(now - growth), 0.2)
                    << "path " << path << " step " << step << " ratio " << frustum.depthRatio();
                growth = now;
                const LightFit best = fitSlice(chosenFrame(frustum, light, warp, std::nullopt), frustum);
                ASSERT_LE(storageFactor(fit, kappaAuto(fit)), 2.1 * storageFactor(best, kappaAuto(best)))
                    << "path " << path << " step " << step;
            }
        }
    }
}

TEST(Auto, TheChosenOrientationHalvesTheWorstSlice) {
    // theory: the best rotation cuts the worst S of a slice (alpha 1000, theta 20, k = 4) from 63 to 36.
    Random random(6);
    double plainWorst = 0;
    double chosenWorst = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec3 light = randomLight(random);
        const LightFit plain = fitSlice(lightFrame(light), kFrusta[0]);
        const LightFit chosen = fitSlice(chosenFrame(kFrusta[0], light, {}, std::nullopt), kFrusta[0]);
        plainWorst = std::max(plainWorst, storageFactor(plain, kappaAuto(plain)));
        chosenWorst = std::max(chosenWorst, storageFactor(chosen, kappaAuto(chosen)));
    }
    EXPECT_GT(plainWorst, 60);
    EXPECT_LT(chosenWorst, 37);
}

TEST(Auto, AllSlicesHaveTheOrientationOfTheOneOfTheLargestDepthRatio) {
    Random random(8);
    for (int i = 0; i < 50; ++i) {
        ShadowView view;
        view.frustum = randomFrustum(random);
        view.towardsLight = randomDirection(random);
        ShadowOptions options;
        options.scheme.slices = 2 + static_cast<int>(random.below(5));
        options.scheme.splitLambda = random.uniform(0, 0.95);
        const std::vector<double> splits =
            practicalSplits(view.frustum.near, view.frustum.far, options.scheme.slices, options.scheme.splitLambda);
        std::size_t leading = 0; // of the largest ratio, whichever that is
        for (std::size_t k = 0; k + 1 < splits.size(); ++k)
            if (splits[k + 1] / splits[k] > splits[leading + 1] / splits[leading]) leading = k;
        const ViewFrustum part = slice(view.frustum, splits[leading], splits[leading + 1]);
        const LightFrame expected = chosenFrame(part, view.towardsLight, {}, std::nullopt);
        EXPECT_EQ(shadowMapSetup(view, options).orientation.zAxis, expected.z) << "round " << i;
    }
}

TEST(Auto, IsTheLeastOfADenseScan) {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const LightFit fit = fitSlice(lightFrame(randomDirection(random)), randomFrustum(random));
        const double max = kappaMinimax(fit);
        double min = storageFactor(fit, 0);
        for (int step = 1; step <= 1000; ++step)
            min = std::min(min, storageFactor(fit, max * step / 1000));
        EXPECT_LE(storageFactor(fit, kappaAuto(fit)), min * (1 + 1e-6));
    }
}

/// What a map of a whole frustum is fitted to where it covers `shown` too.
LightFit coveringFit(const ViewFrustum& frustum, const glm::dvec3& light, const DepthSpan& shown) {
    const PartitionSelector selector = partitionSelector(frustum, light, {frustum.near, frustum.far}, FaceMaps::None);
    return fitRegion(lightFrame(light), frustum, partitionRegion(frustum, selector, 0, shown).vertices);
}

TEST(Warps, MinimaxIsTheLeastWhateverTheMapCoversBeyondItsSlice) {
    Random random(10);
    for (int i = 0; i < 300; ++i) {
        const ViewFrustum frustum = randomFrustum(random);
        const LightFit fit = coveringFit(frustum, randomDirection(random), shownOutside(random, frustum));
        const double found = worstAliasing(fit, kappaMinimax(fit)).z;
        for (double growth = 1e-4; growth < 1e5; growth *= 1.3)
            ASSERT_LE(found, worstAliasing(fit, growth / fit.length).z * (1 + 1e-9)) << i << " " << growth;
    }
}

TEST(Warps, TheLeastStorageIsFoundHoweverWeakTheWarpThatHasIt) {
    Random random(9);
    int weak = 0;
    for (int i = 0; i < 40000; ++i) {
        const LightFit fit = fitSlice(lightFrame(randomDirection(random)), kFrusta[random.below(kFrusta.size())]);
        const double growth = logGrowth(fit);
        if (!(growth > 0.002 && growth < 0.02)) continue; // where the warp begins as the light turns
        double min = storageFactor(fit, 0);
        for (int step = 1; step <= 2000; ++step)
            min = std::min(min, storageFactor(fit, std::expm1(2e-5 * step) / fit.length));
        EXPECT_LE(storageFactor(fit, kappaMinStorage(fit)), min * (1 + 1e-9)) << "at a growth of e^" << growth;
        ++weak;
    }
    EXPECT_GT(weak, 20);
}

TEST(Warps, TsmPutsItsFocusAtFourFifths) {
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
        const ViewFrustum frustum = randomFrustum(random);
        const LightFit fit = fitSlice(lightFrame(randomDirection(random)), frustum);
        const double focus = fit.length * random.uniform(0.01, 0.79);
        const double kappa = kappaTsm(fit, focus, 0.8);
        const double t = focus * (1 + kappa * fit.length) / (fit.length * (1 + kappa * focus));
        EXPECT_NEAR(t, 0.8, 1e-9);
        EXPECT_EQ(kappaTsm(fit, 0.8 * fit.length, 0.8), 0);
    }
}

/// The largest promise of a frame of depth ratio 1000, the light straight overhead, under `rule` with `slices` maps.
double worstBound(WarpRule rule, int slices) {
    ShadowView view;
    view.frustum = {1, 1000, radiansFromDegrees(20), 1};
    ShadowOptions options;
    options.scheme.warp.rule = rule;
    options.scheme.slices = slices;
    const AliasingBound bound = shadowMapSetup(view, options).worst();
    return std::max(bound.x, bound.z);
}

TEST(Warps, TsmWithoutAFocusTakesTheMeanDepthOfItsSlice) {
    Warp tsm;
    tsm.rule = WarpRule::Tsm;
    Random random(9);
    for (int i = 0; i < 1000; ++i) {
        const ViewFrustum frustum = randomFrustum(random);
        const LightFit fit = fitSlice(lightFrame(randomDirection(random)), frustum);
        const glm::dvec3 focus(0, 0, std::sqrt(frustum.near * frustum.far));
        const double expected = kappaTsm(fit, toLight(fit.frame, focus).z - fit.zMin, 0.8);
        ASSERT_NEAR(kappaOf(tsm, fit), expected, 1e-9 * (expected + 1 / fit.length));
    }
    // A focus of 0 is the pole of the rule: it promised 450 and 8.1 where LSPSM promises 14.5 and 2.0.
    EXPECT_LT(worstBound(WarpRule::Tsm, 1), 2 * worstBound(WarpRule::Lspsm, 1));
    EXPECT_LT(worstBound(WarpRule::Tsm, 4), 2 * worstBound(WarpRule::Lspsm, 4));
}

} // namespace
} // namespace gnomon::shadow
