// Logarithmic rows: the closed forms against the maps, against an integral and against finite differences; what a light
// that turns does to them.
#include "shadow/partition/grazing.h"
#include "shadow/scheme.h"
#include "shadow/setup.h"
#include "shadow/warp/warped_map.h"
#include "tests/support/log_forms.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

Scheme logScheme(int slices, bool faces) {
    Scheme scheme;
    scheme.warp.rule = WarpRule::Log;
    scheme.slices = slices;
    scheme.faces = faces;
    return scheme;
}

ViewFrustum squareFrustum(double ratio, double halfDegrees) {
    return {0.3, 0.3 * ratio, halfDegrees * kPi / 180, 1};
}

TEST(LogWarp, OverheadTakesTheLogarithmOverTwiceTheTangent) {
    for (const double degrees : {5.0, 20.0, 30.0, 60.0})
        for (double ratio = 10; ratio <= 1e6; ratio *= std::sqrt(10.0)) {
            const ViewFrustum frustum = squareFrustum(ratio, degrees);
            const double closed = std::log(ratio) / (2 * tanHalfY(frustum));
            for (const glm::dvec3& light : {glm::dvec3(0, 1, 0), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0)}) {
                const std::vector<SchemeMap> maps = schemeMaps(frustum, light, logScheme(1, false));
                EXPECT_NEAR(storageFactor(maps) / closed, 1, 1e-9) << degrees << " " << ratio;
                EXPECT_NEAR(maps[0].unit.x, 1, 1e-9);
                EXPECT_NEAR(maps[0].kappa * frustum.near, 1, 1e-9);
            }
        }
    EXPECT_NEAR(logStorageFactor(squareFrustum(1000, 20), {0, 1, 0}), 9.489, 1e-3) << "as with faces";
}

TEST(LogWarp, AnyOtherKappaOverheadIsATrap) {
    LightFit fit = fitSlice(lightFrame({0, 1, 0}), squareFrustum(1000, 20));
    fit.rows = RowSpacing::Logarithmic;
    const double atEye = *kappaAtEye(fit);
    EXPECT_NEAR(storageFactor(fit, 0.3 * atEye), 87, 0.5);
    EXPECT_NEAR(storageFactor(fit, kappaMinimax(fit)), 4895, 1);
    EXPECT_GT(storageFactor(fit, 0), 1e6);
    EXPECT_GT(storageFactor(fit, 1.01 * atEye), storageFactor(fit, atEye));
}

TEST(LogWarp, OnFacesEveryLightTakesTheClosedForm) {
    const ViewFrustum frustum = squareFrustum(1000, 20);
    Random random(1);
    double worst = 0;
    double sum = 0;
    double worstSheared = 0;
    std::size_t max = 0;
    constexpr int kLights = 100000;
    for (int i = 0; i < kLights; ++i) {
        const glm::dvec3 light = i % 4 == 0 ? randomLight(random) : randomDirection(random);
        const std::vector<SchemeMap> maps = schemeMaps(frustum, light, logScheme(1, true));
        const double found = storageFactor(maps);
        const double sheared = shearedStorageFactor(maps);
        ASSERT_NEAR(found / logStorageFactor(frustum, light), 1, 1e-9) << light.x << " " << light.y << " " << light.z;
        ASSERT_NEAR(sheared / logShearedStorageFactor(frustum, light), 1, 1e-9);
        worst = std::max(worst, found);
        worstSheared = std::max(worstSheared, sheared);
        max = std::max(max, maps.size());
        if (i % 4 != 0) sum += found;
    }
    EXPECT_LE(worst, 15.6);
    EXPECT_GE(worst, 15.57);
    constexpr int kSummed = kLights - kLights / 4;
    EXPECT_NEAR(sum / kSummed, 14.05, 0.02);
    EXPECT_LE(worstSheared, 29.7);
    EXPECT_GE(worstSheared, 29.4);
    EXPECT_EQ(max, 5U);
}

constexpr std::array kAllFaces{Face::Top, Face::Bottom, Face::Left, Face::Right, Face::Near};

/// The least sine of the angle from `light` to a face.
double minSine(const ViewFrustum& frustum, const glm::dvec3& light) {
    double min = 1;
    for (const Face face : kAllFaces)
        min = std::min(min, std::abs(glm::dot(outwardNormal(frustum, face), light)));
    return min;
}

/// Whether a face or the near square of `frustum` has no map.
bool isLeftToNeighbours(const ViewFrustum& frustum, const glm::dvec3& light) {
    return std::any_of(kAllFaces.begin(), kAllFaces.end(), [&](Face face) {
        const double min = face == Face::Near ? kGrazing : minGrazing(frustum, RowSpacing::Logarithmic);
        return std::abs(glm::dot(outwardNormal(frustum, face), light)) <= min;
    });
}

/// A light within 2e-3 of the plane of a face.
glm::dvec3 grazingLight(Random& random, const ViewFrustum& frustum) {
    const glm::dvec3 normal = outwardNormal(frustum, kAllFaces[random.below(kAllFaces.size())]);
    const glm::dvec3 any = randomDirection(random);
    const double sine = random.uniform(-2e-3, 2e-3);
    return glm::normalize(glm::normalize(any - normal * glm::dot(any, normal)) + normal * sine);
}

/// S of the maps of a setup and not those of the theory: near squares lean, so that nothing around them is covered.
Aliasing drawnStorage(const ShadowMapSetup& setup) {
    Aliasing sum; // S, and with the shear
    for (const ShadowMap& map : setup.maps) {
        LightFit fit = fitRegion(map.warped.frame, map.region.frustum, map.region.vertices);
        fit.rows = map.warped.rows;
        const Aliasing unit = worstAliasing(fit, map.warped.kappa);
        sum.x += unit.x * unit.z;
        sum.z += unit.x * worstShearedAliasing(fit, map.warped.kappa);
    }
    return sum;
}

/// Holds the maps of so many lights, each second of which grazes a face, to the bars.
void checkDrawnStorage(std::uint64_t seed, int lights) {
    ShadowView view;
    view.frustum = squareFrustum(1000, 20);
    ShadowOptions options;
    options.scheme = logScheme(1, true);
    Random random(seed);
    Aliasing worst;
    int leaning = 0;
    int leftToNeighbours = 0;
    for (int i = 0; i < lights; ++i) {
        view.towardsLight = i % 2 == 0 ? randomDirection(random) : grazingLight(random, view.frustum);
        if (i == 0) view.towardsLight = glm::normalize(glm::dvec3(-0.592, -0.628, -0.504));
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        ASSERT_LE(setup.maps.size(), 5U);
        const Aliasing found = drawnStorage(setup);
        for (const ShadowMap& map : setup.maps)
            leaning += std::abs(lean(map.warped.frame)) > 0.1 ? 1 : 0;
        worst = {std::max(worst.x, found.x), std::max(worst.z, found.z)};
        // Faces that are left to their neighbours make these cover more.
        if (isLeftToNeighbours(view.frustum, view.towardsLight)) {
            ++leftToNeighbours;
            continue;
        }
        const double rounding = 1e-6 + 1e-7 / minSine(view.frustum, view.towardsLight);
        ASSERT_NEAR(found.x / logStorageFactor(view.frustum, view.towardsLight), 1, rounding) << i;
    }
    std::printf("worst %g, sheared %g\n", worst.x, worst.z);
    EXPECT_LE(worst.x, 15.6);
    EXPECT_GE(worst.x, 15.57);
    EXPECT_LE(worst.z, 29.7);
    EXPECT_GT(leaning, lights / 4);
    EXPECT_GT(leftToNeighbours, lights / 200);
}

TEST(LogWarp, DrawnMapsTakeTheClosedFormToo) {
    checkDrawnStorage(2, 8000);
}

TEST(SlowLogWarp, DrawnMapsTakeTheClosedFormOver100000Lights) {
    checkDrawnStorage(3, 100000);
}

/// Where the light grazes a face floats miss rows by more than a subpixel, which the bias of its map reckons with.
TEST(LogWarp, GrazedFacesAreLookedUpWithinTheirReach) {
    ShadowView view;
    view.frustum = squareFrustum(1000, 20);
    ShadowOptions options;
    options.scheme = logScheme(1, true);
    Random random(4);
    double missed = 0;
    for (int i = 0; i < 4000; ++i) {
        view.towardsLight = grazingLight(random, view.frustum);
        const ShadowMapSetup setup = shadowMapSetup(view, options);
        for (int k = 0; k < 20; ++k) {
            const glm::vec3 p(randomPointIn(random, view.frustum));
            const ShadowMap& map = setup.maps.at(setup.mapOf(p));
            const DoubleMapImage image = cameraImage(map);
            const double apart = std::abs(double{texelAt(rounded(image), p).row} - texelAt(image, glm::dvec3(p)).row);
            ASSERT_LE(apart, image.reach - 0.5 + 0.04) << i;
            missed = std::max(missed, apart);
        }
    }
    EXPECT_GT(missed, 0.05) << "they do, or nothing is tested";
}

TEST(LogWarp, OnFacesIsContinuousInTheLight) {
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        const ViewFrustum frustum = randomFrustum(random);
        const glm::dvec3 light = randomLight(random);
        const double angle = std::pow(10.0, random.uniform(-9, -2));
        const glm::dvec3 turned = directionNear(random, light, angle);
        // Each term is at most a constant times the sine of an angle; the sum of the constants bounds the slope.
        const double slope = std::log(frustum.depthRatio()) * (frustum.aspect + 1) * 4 /
                                 (std::sin(frustum.halfFovYRadians) * std::min(1.0, tanHalfY(frustum))) +
                             2 * frustum.aspect;
        ASSERT_NEAR(
            storageFactor(schemeMaps(frustum, light, logScheme(1, true))),
            storageFactor(schemeMaps(frustum, turned, logScheme(1, true))),
            slope * angle)
            << seed;
    }
}

/// The integral of 1 / w_i^2 over what the light sees of `face`, by the midpoint of cells even in depth's logarithm,
/// extrapolated (Romberg); areas are products of differences, and no frame, fit or map is involved.
double integratedDensity(const ViewFrustum& frustum, const glm::dvec3& light, Face face) {
    const std::array<FitVertex, 4> vertices = faceVertices(frustum, face);
    const auto at = [&](double along, double across) {
        const glm::dvec3 ray = glm::mix(vertices[0].position, vertices[1].position, across) / frustum.near;
        return ray * (frustum.near * std::pow(frustum.depthRatio(), along));
    };
    const auto sum = [&](int cells) {
        double total = 0;
        for (int i = 0; i < cells; ++i) {
            const double low = static_cast<double>(i) / cells;
            const double high = static_cast<double>(i + 1) / cells;
            const double middle = (low + high) / 2;
            const double halfway = at(middle, 0.5).z;
            // A strip of the face across: a trapezoid.
            const glm::dvec3 mean = (at(low, 1) - at(low, 0) + at(high, 1) - at(high, 0)) / 2.0;
            const double seen = std::abs(glm::dot(glm::cross(mean, at(high, 0) - at(low, 0)), light));
            const double pixel = imageBeamWidth(frustum, halfway, 1);
            total += seen / (pixel * pixel);
        }
        return total;
    };
    std::array<double, 5> row{};
    for (int i = 0; i < 5; ++i) {
        double better = sum(512 << i);
        for (int k = 0; k < i; ++k)
            better += (better - std::exchange(row[static_cast<std::size_t>(k)], better)) / (std::pow(4.0, k + 1) - 1);
        row[static_cast<std::size_t>(i)] = better;
    }
    return row[4];
}

TEST(LogWarp, IsTheIntegralOfWhatPixelsAskFor) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        Random random(seed);
        const ViewFrustum frustum = randomFrustum(random);
        const glm::dvec3 light = randomDirection(random);
        double sum = frustum.aspect * std::abs(light.z);
        for (const Face face : sideFaces(frustum, light))
            sum += integratedDensity(frustum, light, face);
        EXPECT_NEAR(sum / logStorageFactor(frustum, light), 1, 1e-9) << seed;
    }
}

TEST(LogWarp, ShearIsWhatGrazingFacesAskFor) {
    const ViewFrustum frustum = squareFrustum(1000, 20);
    const glm::dvec3 normal = outwardNormal(frustum, Face::Top);
    const glm::dvec3 across(1, 0, 0);
    const glm::dvec3 along = glm::cross(normal, across);
    // The largest ratio of M_t to M_z of the top's map over all lights at a cosine to its normal.
    const auto lean = [&](double cosine) {
        double worst = 0;
        for (int i = 0; i < 3600; ++i) {
            const double angle = 2 * kPi * i / 3600;
            const glm::dvec3 level = along * std::cos(angle) + across * std::sin(angle);
            const glm::dvec3 light = glm::normalize(normal * cosine + level * std::sqrt(1 - cosine * cosine));
            LightFit fit = fitFace(frustum, light, Face::Top, Bisector::NearEdge);
            fit.rows = RowSpacing::Logarithmic;
            const double kappa = *kappaAtEye(fit);
            worst = std::max(worst, worstShearedAliasing(fit, kappa) / worstAliasing(fit, kappa).z);
        }
        return worst;
    };
    EXPECT_NEAR(lean(0.05), 14.01, 0.01);
    EXPECT_NEAR(lean(0.001), 699.4, 0.5);
}

/// A map with logarithmic rows of a random slice, in a random roll.
WarpedMap randomLogMap(Random& random, const ViewFrustum& frustum, LightFit& fit) {
    fit = fitSlice(rolled(lightFrame(randomLight(random)), random.uniform(-3, 3)), frustum);
    fit.rows = RowSpacing::Logarithmic;
    const double growth = random.below(2) == 0 ? random.uniform(0.01, 12) : std::log1p(kappaLog(fit) * fit.length);
    return warpedMap(fit, std::max(1e-6, std::expm1(growth)) / fit.length);
}

TEST(LogWarp, FiniteDifferencesAreTheJacobianAndTheBeams) {
    for (std::uint64_t seed = 0; seed < 5000 && !testing::Test::HasFatalFailure(); ++seed) {
        Random random(seed);
        const ViewFrustum frustum = randomFrustum(random);
        LightFit fit;
        const WarpedMap map = randomLogMap(random, frustum, fit);
        const glm::dvec3 p = randomPointIn(random, frustum);
        const MapPoint at = mapPoint(map, p);
        // The t of even rows, which the matrix gives, and what logarithmic ones make of it.
        const glm::dvec4 even = textureFromCamera(map) * glm::dvec4(p, 1);
        const double warp = map.kappa * map.length;
        ASSERT_NEAR(-std::log(1 - even.y / even.w * warp / (1 + warp)) / std::log1p(warp), at.t, 1e-9) << seed;
        const double step = 1e-3 * at.w / std::max(map.kappa, 1 / map.length);
        const auto slope = [&](const glm::dvec3& axis, double h) {
            const MapPoint high = mapPoint(map, p + axis * h);
            const MapPoint low = mapPoint(map, p - axis * h);
            return glm::dvec3(high.s - low.s, high.t - low.t, high.depth - low.depth) / (2 * h);
        };
        const MapJacobian jacobian = mapJacobian(map, p);
        const LightBeam beam = lightBeam(map, p, {});
        for (const glm::dvec3& axis : {map.frame.x, map.frame.z, randomDirection(random)}) {
            const glm::dvec3 coarse = slope(axis, step);
            const glm::dvec3 fine = slope(axis, step / 2);
            const double slack =
                glm::length(fine - coarse) + 4e-14 * (1 + glm::length(glm::dvec3(at.s, at.t, at.depth))) / step;
            const glm::dvec3 closed(
                glm::dot(jacobian.s, axis), glm::dot(jacobian.t, axis), glm::dot(jacobian.depth, axis));
            ASSERT_LE(glm::length((4.0 * fine - coarse) / 3.0 - closed), slack + 1e-9 * glm::length(closed)) << seed;
        }
        ASSERT_NEAR(glm::dot(jacobian.s, map.frame.x) * beam.x, 1, 1e-9) << seed;
        ASSERT_NEAR(glm::dot(jacobian.t, map.frame.z) * beam.z, 1, 1e-9) << seed;
        const std::optional<glm::dvec2> back = lightPlanePoint(map, at.s, at.t);
        const glm::dvec3 light = toLight(map.frame, p);
        ASSERT_TRUE(back);
        ASSERT_NEAR(glm::length(*back - glm::dvec2(light.x, light.z)), 0, 1e-9 * (map.length + std::abs(light.x)))
            << seed;
    }
}

TEST(LogWarp, NoPointIsAboveWhatTheVerticesSay) {
    for (std::uint64_t seed = 0; seed < 3000 && !testing::Test::HasFatalFailure(); ++seed) {
        Random random(seed);
        const ViewFrustum frustum = randomFrustum(random);
        LightFit fit;
        const WarpedMap map = randomLogMap(random, frustum, fit);
        const Aliasing worst = worstAliasing(fit, map.kappa);
        const double sheared = worstShearedAliasing(fit, map.kappa);
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = randomPointIn(random, frustum);
            const LightBeam beam = lightBeam(map, p, {});
            const double pixel = imageBeamWidth(frustum, p.z, 1);
            ASSERT_LE(beam.x / pixel, worst.x * (1 + 1e-9)) << seed;
            ASSERT_LE(beam.z / pixel, worst.z * (1 + 1e-9)) << seed;
            ASSERT_LE(beam.sheared / pixel, sheared * (1 + 1e-9)) << seed;
        }
    }
}

TEST(LogWarp, IsNeverMoreThanEvenRowsWithoutWarp) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const ViewFrustum frustum = randomFrustum(random);
        const glm::dvec3 light = randomLight(random);
        const double log = storageFactor(schemeMaps(frustum, light, logScheme(1, false)));
        Scheme none;
        none.warp.rule = WarpRule::None;
        none.slices = 1;
        EXPECT_LE(log, storageFactor(schemeMaps(frustum, light, none)) * (1 + 1e-9)) << seed;
    }
}

} // namespace
} // namespace gnomon::shadow
