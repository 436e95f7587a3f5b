// Maps fitted to the samples of a view: derivatives, what is promised against what samples have, bias, casters, and
// where rows are drawn against where they are looked up.
#include "random_samples.h"
#include "shadow/setup.h"
#include "shadow/view_fit.h"
#include "shadow/warp/fitted_axis.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

namespace gnomon::shadow {
namespace {

/// A fitted map of a random setup, and a sample that it is asked for; nothing where none is.
struct AskedMap {
    FittedCase from;
    ShadowMapSetup setup;
    const ShadowMap* map = nullptr;
    std::vector<glm::dvec3> samples;
};

AskedMap randomAskedMap(Random& random, int samples) {
    AskedMap result{randomFittedCase(random, samples), {}, nullptr, {}};
    result.setup = shadowMapSetup(result.from.view, result.from.options);
    const glm::dvec3 first((*result.from.view.samples)[random.below(static_cast<std::uint64_t>(samples))]);
    const std::size_t index = result.setup.mapOf(first);
    result.map = &result.setup.maps.at(index);
    for (const glm::vec3& sample : *result.from.view.samples)
        if (result.setup.mapOf(sample) == index) result.samples.emplace_back(sample);
    return result;
}

/// Differences next to a warp's centre have no digits left.
bool isSteep(const WarpedMap& map) {
    return map.kappa * map.length > 3e3;
}

/// Where a difference may be of two parts of `axis`.
bool isNearEndOfPart(const FittedAxis& axis, double at) {
    const double part = (at - axis.low()) / (axis.high() - axis.low()) * kFittedParts;
    const double inPart = part - std::floor(part);
    return inPart < 0.01 || inPart > 0.99;
}

TEST(FittedMaps, FiniteDifferencesAreTheJacobianAndTheBeamsAndPointsComeBack) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 1500 && !testing::Test::HasFatalFailure(); ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 60);
        const WarpedMap& map = asked.map->warped;
        ASSERT_TRUE(map.fitted);
        if (isSteep(map)) continue;
        const glm::dvec3 p = asked.samples[random.below(asked.samples.size())];
        const MapPoint at = mapPoint(map, p);
        const double step = 1e-6 * at.w / std::max(map.kappa, 1 / map.length);
        if (isNearEndOfPart(map.fitted->rows, unfittedT(map, p))) continue;
        if (isNearEndOfPart(map.fitted->columns, unfittedS(map, p))) continue;
        const MapJacobian jacobian = mapJacobian(map, p);
        for (const glm::dvec3& axis : {alongX(map.frame), map.frame.z, randomDirection(random)}) {
            const MapPoint high = mapPoint(map, p + axis * step);
            const MapPoint low = mapPoint(map, p - axis * step);
            const glm::dvec2 found(high.s - low.s, high.t - low.t);
            const glm::dvec2 closed(glm::dot(jacobian.s, axis), glm::dot(jacobian.t, axis));
            const double scale = 1 + std::abs(at.s) + std::abs(at.t) + glm::length(closed) * step;
            ASSERT_LE(glm::length(found / (2 * step) - closed), 1e-5 * glm::length(closed) + 1e-13 * scale / step)
                << seed;
        }
        const LightBeam beam = lightBeam(map, p, {});
        ASSERT_NEAR(glm::dot(jacobian.s, alongX(map.frame)) * beam.x, 1, 1e-9) << seed;
        ASSERT_NEAR(glm::dot(jacobian.t, map.frame.z) * beam.z, 1, 1e-9) << seed;
        const std::optional<glm::dvec2> back = lightPlanePoint(map, at.s, at.t);
        const glm::dvec3 light = toLight(map.frame, p);
        ASSERT_TRUE(back);
        ASSERT_NEAR(glm::length(*back - glm::dvec2(light.x, light.z)), 0, 1e-9 * (map.length + std::abs(light.x)))
            << seed;
        ++tested;
    }
    EXPECT_GT(tested, 1000);
}

TEST(FittedMaps, HoldEverySampleInTheirRectangle) {
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 60);
        const DoubleMapImage image = cameraImage(*asked.map);
        const TexelRectangle inner = asked.map->innerRectangle();
        ASSERT_FALSE(inner.transposed);
        for (const glm::dvec3& p : asked.samples) {
            const MapTexel<double> at = texelAt(image, p);
            ASSERT_GE(at.column, inner.x - 1e-3) << seed;
            ASSERT_LE(at.column, inner.x + inner.width + 1e-3) << seed;
            ASSERT_GE(at.row, inner.y - 1e-6) << seed;
            ASSERT_LE(at.row, inner.y + inner.height + 1e-6) << seed;
            ASSERT_NEAR(glm::length(glm::dvec2(at.column, at.row) - exactTexel(*asked.map, p)), 0, 1e-4) << seed;
        }
    }
}

/// Casters are drawn where a lookup of theirs would read the middle of a row, in the floats of both.
TEST(FittedMaps, DrawRowsWhereLookupsReadThem) {
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 60);
        const TexelRectangle& r = asked.map->rectangle;
        const FloatMapImage image = rounded(cameraImage(*asked.map));
        const std::vector<float> rows = rowPositions(image, r.y, r.height);
        ASSERT_EQ(rows.size(), static_cast<std::size_t>(r.height));
        for (std::size_t i = 0; i < rows.size(); ++i) {
            ASSERT_LT(i > 0 ? rows[i - 1] : rows[i] - 1, rows[i]) << seed;
            const double up = image.logRows == 0 ? double{rows[i]} : -std::log(-double{rows[i]});
            const double unfitted = up * double{image.texelScale.y} + double{image.texelOffset.y};
            const double read = image.fitted->rows.texelAt(static_cast<float>(unfitted));
            ASSERT_NEAR(read, r.y + static_cast<double>(i) + 0.5, 0.02 + 1e-5 * r.height) << seed << " " << i;
        }
    }
}

TEST(FittedMaps, DrawColumnsWhereLookupsReadThem) {
    int uneven = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 60);
        const TexelRectangle& r = asked.map->rectangle;
        const FloatMapImage image = rounded(cameraImage(*asked.map));
        std::vector<EvenColumns> runs = columnRuns(image, r.x, r.width);
        uneven += runs.empty() ? 0 : 1;
        if (runs.empty())
            runs.push_back({r.x + r.width, image.texelScale.x, static_cast<float>(r.x) + image.texelScale.x});
        int column = r.x;
        double before = -1e9;
        for (const EvenColumns& run : runs)
            for (; column < run.end; ++column) {
                const double across = (column + 0.5 - double{run.offset}) / double{run.scale};
                ASSERT_GT(across, before) << seed;
                before = across;
                const double unfitted = across * double{image.texelScale.x} + double{image.texelOffset.x};
                const double read = image.fitted->columns.texelAt(static_cast<float>(unfitted));
                ASSERT_NEAR(read, column + 0.5, 0.02 + 1e-5 * r.width) << seed;
            }
        ASSERT_EQ(column, r.x + r.width);
    }
    EXPECT_GT(uneven, 200);
}

/// Where in clip space, over w, what is looked up at `texel` of the texture lies, at depth `z`: the inverse of texelAt
/// by halving.
glm::dvec4 clipOfTexel(const DoubleMapImage& image, const glm::dvec2& texel, double z) {
    const auto unfitted = [](const AxisParts<double>& parts, double fitted) {
        double low = -1e5;
        double high = 1e5;
        for (int i = 0; i < 80; ++i) {
            const double middle = (low + high) / 2;
            (parts.texelAt(middle) <= fitted ? low : high) = middle;
        }
        return low;
    };
    const double up = (unfitted(image.fitted->rows, texel.y) - image.texelOffset.y) / image.texelScale.y;
    const double x = (unfitted(image.fitted->columns, texel.x) - image.texelOffset.x) / image.texelScale.x;
    return {x, image.logRows == 0 ? up : -std::exp(-up), z, 1};
}

/// A kernel's reach from where `p` is looked up, to a corner.
glm::dvec2 corner(const DoubleMapImage& image, const glm::dvec3& p, int which, double reach) {
    const MapTexel<double> at = texelAt(image, p);
    return {at.column + ((which & 1) != 0 ? reach : -reach), at.row + ((which & 2) != 0 ? reach : -reach)};
}

TEST(FittedMaps, AreBiasedByWhatTheReceiversPlaneRisesOverTheirOwnRows) {
    int tested = 0;
    double tightest = 1e9;
    for (std::uint64_t seed = 0; seed < 3000; ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 40);
        const glm::dvec3 normal = randomDirection(random);
        const double cosine = glm::dot(normal, asked.from.view.towardsLight);
        if (cosine < kLeastCosine || isSteep(asked.map->warped)) continue;
        const glm::dvec3 p = asked.samples[random.below(asked.samples.size())];
        const DoubleMapImage image = cameraImage(*asked.map);
        const glm::dmat4 offsetFromClip = glm::inverse(image.clipFromOffset);
        const glm::dvec4 plane(normal, -glm::dot(normal, p - image.origin));
        const double bias = receiverBias(image, p, normal, cosine);
        const double depth = texelAt(image, p).depth;
        double rise = 0;
        for (const int which : {0, 1, 2, 3}) {
            const glm::dvec2 texel = corner(image, p, which, std::max(1.0, asked.from.options.filterTexels) / 2);
            const double atZero = glm::dot(plane, offsetFromClip * clipOfTexel(image, texel, 0));
            rise = std::max(rise, depth + atZero / glm::dot(plane, offsetFromClip[2]));
        }
        EXPECT_GE(bias, rise * (1 - 1e-5)) << "seed " << seed;
        tightest = std::min(tightest, bias / std::max(rise, 1e-12));
        // Nor can any receiver of the map ask for a bias that its depth range has no room for.
        EXPECT_LE(
            bias,
            largestRawBias(
                fitRegion(asked.map->warped.frame, asked.map->region.frustum, asked.map->region.vertices),
                asked.map->warped.kappa,
                {1,
                 asked.map->texels().s * asked.map->warped.fitted->columns.leastDensity(),
                 asked.map->texels().t * asked.map->warped.fitted->rows.leastDensity()},
                asked.from.options.filterTexels) /
                    asked.map->warped.rawRange * 1.5 +
                kDepthRounding)
            << seed;
        ++tested;
    }
    EXPECT_GT(tested, 400);
    EXPECT_LT(tightest, 1.5) << "far more than is asked for lets light in";
}

TEST(FittedMaps, CasterVolumesHoldEveryTexelThatASampleReads) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const AskedMap asked = randomAskedMap(random, 60);
        if (isSteep(asked.map->warped)) continue;
        const DoubleMapImage image = cameraImage(*asked.map);
        const glm::dmat4 offsetFromClip = glm::inverse(image.clipFromOffset);
        for (const glm::dvec3& p : asked.samples) {
            const glm::dvec2 texel =
                corner(image, p, static_cast<int>(random.below(4)), asked.map->gutter * random.uniform(0, 0.999));
            const glm::dvec4 offset = offsetFromClip * clipOfTexel(image, texel, random.uniform(-1, 0.999));
            if (!(offset.w > 0)) continue;
            const glm::dvec3 caster = glm::dvec3(offset) / offset.w + image.origin;
            double inside = 1e300;
            for (const Plane& plane : asked.map->casterVolume.planes)
                inside = std::min(inside, plane.signedDistance(caster));
            ASSERT_GE(inside, -1e-6 * asked.map->region.frustum.far - 1e-6 * glm::length(caster)) << "seed " << seed;
            ++tested;
        }
    }
    EXPECT_GT(tested, 5000);
}

struct Aliased {
    double x = 0;
    double z = 0;
    double sheared = 0;
};

/// The aliasing at `p` by finite differences of what is looked up, in real texels and pixels.
Aliased aliasedAt(const ShadowMap& map, const ShadowView& view, const glm::dvec3& p) {
    const double h = 1e-6 * mapPoint(map.warped, p).w / std::max(map.warped.kappa, 1 / map.warped.length);
    const DoubleMapImage image = cameraImage(map);
    const auto slope = [&](const glm::dvec3& axis) {
        const MapTexel<double> high = texelAt(image, p + axis * h);
        const MapTexel<double> low = texelAt(image, p - axis * h);
        return glm::dvec2(high.column - low.column, high.row - low.row) / (2 * h);
    };
    const glm::dvec2 perX = slope(alongX(map.warped.frame));
    const glm::dvec2 perZ = slope(map.warped.frame.z);
    const double pixel = imageBeamWidth(view.frustum, p.z, view.imageHeight);
    const double shear = -perZ.x / perX.x;
    return {1 / perX.x / pixel, 1 / perZ.y / pixel, std::sqrt(1 + shear * shear) / perZ.y / pixel};
}

/// The promise is of the samples: no sample is above it, and one comes near, as the promise is no bound of a frustum.
void checkPromise(std::uint64_t seed, int samples, double& nearest) {
    Random random(seed);
    FittedCase made = randomFittedCase(random, samples);
    made.options.filterTexels = 0;
    const ShadowMapSetup setup = shadowMapSetup(made.view, made.options);
    Aliased worst;
    const PromisedAliasing promised = setup.worst();
    for (const glm::vec3& sample : *made.view.samples) {
        const ShadowMap& map = setup.maps.at(setup.mapOf(sample));
        if (isSteep(map.warped)) continue;
        const Aliased found = aliasedAt(map, made.view, sample);
        constexpr double kSlack = 1 + 1e-5; // of the differences
        ASSERT_LE(found.x, map.promised.x * kSlack) << "seed " << seed;
        ASSERT_LE(found.z, map.promised.z * kSlack) << "seed " << seed;
        ASSERT_LE(found.sheared, map.promised.sheared * kSlack) << "seed " << seed;
        worst = {std::max(worst.x, found.x), std::max(worst.z, found.z), std::max(worst.sheared, found.sheared)};
    }
    if (worst.x > 0) nearest = std::max(nearest, worst.x / promised.x);
}

TEST(FittedMaps, NoSampleIsAboveThePromise) {
    double nearest = 0;
    for (std::uint64_t seed = 0; seed < 1000 && !HasFatalFailure(); ++seed)
        checkPromise(seed, 100, nearest);
    EXPECT_GT(nearest, 0.999);
}

/// A million samples of a thousand plans.
TEST(SlowFittedMaps, NoSampleIsAboveThePromise) {
    double nearest = 0;
    for (std::uint64_t seed = 7000; seed < 8000 && !HasFatalFailure(); ++seed)
        checkPromise(seed, 1000, nearest);
}

/// What is promised for the samples is at most what the same texels promise for the frustum with logarithmic rows; for
/// samples in a clump far less.
TEST(FittedMaps, PromiseNoMoreThanLogarithmicRows) {
    double sum = 0;
    int count = 0;
    for (std::uint64_t seed = 0; seed < 600; ++seed) {
        Random random(seed);
        FittedCase made = randomFittedCase(random, 200);
        made.options.texels = 1U << 20U;
        const ShadowMapSetup fitted = shadowMapSetup(made.view, made.options);
        made.options.scheme.warp.rule = WarpRule::Log;
        const ShadowMapSetup log = shadowMapSetup(made.view, made.options);
        if (log.maps.front().warped.kappa * log.maps.front().warped.length > 9e3) continue; // steeper than is fitted
        // Whole texels, gutters and packing of maps of other shapes cost a little.
        EXPECT_LE(fitted.worst().worst(), log.worst().worst() * 1.1) << seed;
        sum += fitted.worst().worst() / log.worst().worst();
        ++count;
    }
    ASSERT_GT(count, 300);
    EXPECT_LT(sum / count, 0.6);
}

TEST(FittedMaps, WithoutSamplesAreLogarithmic) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        Random random(seed);
        FittedCase made = randomFittedCase(random, 1);
        made.view.frustum.far = std::min(made.view.frustum.far, made.view.frustum.near * 500);
        made.view.samples.reset();
        const ShadowMapSetup fitted = shadowMapSetup(made.view, made.options);
        made.options.scheme.warp.rule = WarpRule::Log;
        const ShadowMapSetup log = shadowMapSetup(made.view, made.options);
        ASSERT_EQ(fitted.maps.size(), log.maps.size());
        for (std::size_t i = 0; i < log.maps.size(); ++i) {
            EXPECT_EQ(fitted.maps[i].promised.z, log.maps[i].promised.z);
            EXPECT_FALSE(fitted.maps[i].warped.fitted);
        }
    }
}

/// Samples by the ten thousand are counted by several threads: none is left out, and their number changes nothing.
TEST(FittedMaps, OfManySamplesAreTheSameForAnyNumberOfThreads) {
    double nearest = 0;
    for (std::uint64_t seed = 0; seed < 6 && !HasFatalFailure(); ++seed) {
        checkPromise(seed, 20000, nearest);
        Random random(seed);
        const FittedCase made = randomFittedCase(random, 20000);
        const ShadowMapSetup setup = shadowMapSetup(made.view, made.options);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        EXPECT_EQ(shadowMapSetup(made.view, made.options).fits, setup.fits) << seed;
    }
    EXPECT_GT(nearest, 0.99);
}

/// The best rows that there are: a twin that knows the needs of each part and nothing else, by trying promises.
TEST(FittedMaps, AreWithinTheirSlackOfTheLeastPromise) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        Random random(seed);
        const FittedCase made = randomFittedCase(random, 300);
        const LightFit whole = [&] {
            LightFit fit = fitSlice(lightFrame(made.view.towardsLight), made.view.frustum);
            fit.rows = RowSpacing::Logarithmic;
            return fit;
        }();
        const double kappa = std::min(kappaLog(whole), 1e3 / whole.length);
        if (!(kappa * whole.length > 0.05)) continue;
        const WarpedMap base = warpedMap(whole, kappa);
        SampleNeeds needs(base, made.view.frustum);
        std::array<double, kFittedParts> most{};
        double all = 0;
        double x = 0;
        for (const glm::vec3& sample : *made.view.samples) {
            needs.add(sample);
            const double need =
                lightBeam(base, sample, {}).sheared / imageBeamWidth(made.view.frustum, double{sample.z}, 1);
            const double t = unfittedT(base, sample);
            double& part = most[static_cast<std::size_t>(std::clamp(t * kFittedParts, 0.0, kFittedParts - 1.0))];
            part = std::max(part, need);
            all = std::max(all, need);
            x = std::max(x, lightBeam(base, sample, {}).x / imageBeamWidth(made.view.frustum, double{sample.z}, 1));
        }
        // Rows over all of t, as many to a part as its need asks for: so many are called for in all.
        double least = 0;
        for (const double need : most)
            least += need / kFittedParts;
        const MapFit fit = needs.fit({x * 2, all * 2});
        const SampleNeeds::Found found = needs.under(fit);
        // Parts lie elsewhere, are as dense as what lies beside them asks, and those that nobody sees take some too.
        EXPECT_LE(found.sheared.most, std::max(4.5 * least, all / kMostRowDensity * 1.5)) << seed;
        EXPECT_LE(found.sheared.most, all * 2 * (1 + 1e-9)) << seed;
        EXPECT_LE(found.x.most, x * (1 + 1e-3)) << "columns that are no better lie evenly " << seed;
        EXPECT_TRUE(needs.areWithin(fit));
    }
}

} // namespace
} // namespace gnomon::shadow
