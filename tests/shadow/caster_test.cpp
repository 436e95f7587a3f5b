// Caster volumes: nothing outside shadows the region, everything inside can, and no plane can be moved in.
#include "shadow/caster_volume.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

#include <optional>

namespace gnomon::shadow {
namespace {

/// Where the ray from `p` away from the light meets `volume`: the parameters [low, high], empty where low > high.
struct Chord {
    double low = 0;
    double high = std::numeric_limits<double>::infinity();
};

Chord shadowChord(const ConvexVolume& volume, const glm::dvec3& p, const glm::dvec3& towardsLight) {
    Chord chord;
    for (const Plane& plane : volume.planes) {
        const double at = plane.signedDistance(p);
        const double slope = -glm::dot(plane.normal, towardsLight);
        if (std::abs(slope) < 1e-15) {
            if (at < 0) chord.high = -1;
        } else if (slope > 0) {
            chord.low = std::max(chord.low, -at / slope);
        } else {
            chord.high = std::min(chord.high, at / -slope);
        }
    }
    return chord;
}

/// The least signed distance of `p` to the planes of `volume`.
double depthInside(const ConvexVolume& volume, const glm::dvec3& p) {
    double minDistance = std::numeric_limits<double>::infinity();
    for (const Plane& plane : volume.planes)
        minDistance = std::min(minDistance, plane.signedDistance(p));
    return minDistance;
}

struct Case {
    ShadowMapSetup setup;
    ShadowView view;
};

Case randomCase(Random& random) {
    Case result;
    result.view = randomView(random);
    ShadowOptions options = randomOptions(random, result.view.frustum);
    options.stabilized = false;
    result.setup = shadowMapSetup(result.view, options);
    return result;
}

/// A point of the region, moved up or down along the light and a little across it.
glm::dvec3 randomCaster(Random& random, const Region& region, const glm::dvec3& towardsLight) {
    const double size = region.frustum.far;
    glm::dvec3 p = randomPointIn(random, region.frustum);
    p += towardsLight * (size * random.uniform(-1, 3));
    if (random.below(2) == 0) p += randomDirection(random) * (size * random.uniform(0, 0.5));
    return p;
}

void checkCasters(std::uint64_t seed, int casters) {
    Random random(seed);
    const Case chosen = randomCase(random);
    const ShadowMap& map = chosen.setup.maps[random.below(chosen.setup.maps.size())];
    const ConvexVolume sweep = casterVolume(map.region, map.warped.frame);
    const double tolerance = 1e-9 * map.region.frustum.far;
    for (int i = 0; i < casters; ++i) {
        const glm::dvec3 p = randomCaster(random, map.region, map.warped.frame.y);
        const Chord chord = shadowChord(map.region.volume, p, map.warped.frame.y);
        const double inside = depthInside(sweep, p);
        // The middle of a chord through the region lies inside the region; one that only touches it does not.
        const glm::dvec3 middle = p - map.warped.frame.y * ((chord.low + chord.high) / 2);
        const bool shadows = chord.low <= chord.high && depthInside(map.region.volume, middle) > tolerance;
        ASSERT_FALSE(inside < -tolerance && shadows) << "a caster outside shadows the region, seed " << seed;
        ASSERT_FALSE(inside > tolerance && chord.low > chord.high) << "one inside shadows nothing, seed " << seed;
        const bool droppedByGrown = depthInside(map.casterVolume, p) < -tolerance;
        ASSERT_FALSE(droppedByGrown && inside > tolerance) << "grown is smaller than ungrown, seed " << seed;
    }
}

TEST(Casters, OutsideNeverShadowsAndInsideAlwaysCan) {
    for (std::uint64_t seed = 0; seed < 500 && !HasFatalFailure(); ++seed)
        checkCasters(seed, 100);
}

TEST(SlowCasters, OutsideNeverShadowsAndInsideAlwaysCan) {
    for (std::uint64_t seed = 0; seed < 1000 && !HasFatalFailure(); ++seed)
        checkCasters(seed, 1000);
}

TEST(Casters, NoPlaneCanBeMovedIn) {
    for (std::uint64_t seed = 0; seed < 1000; ++seed) {
        Random random(seed);
        const Case chosen = randomCase(random);
        for (const ShadowMap& map : chosen.setup.maps) {
            const ConvexVolume sweep = casterVolume(map.region, map.warped.frame);
            EXPECT_GE(sweep.planes.size(), 3U);
            for (const Plane& plane : sweep.planes) {
                EXPECT_NEAR(glm::length(plane.normal), 1, 1e-12);
                double minDistance = std::numeric_limits<double>::infinity();
                for (const FitVertex& vertex : map.region.vertices)
                    minDistance = std::min(minDistance, plane.signedDistance(vertex.position));
                EXPECT_NEAR(minDistance / map.region.frustum.far, 0, 1e-9) << "seed " << seed;
            }
        }
    }
}

TEST(PointCasters, AreTheHullOfCornersAndLight) {
    Random random(12);
    int outside = 0;
    for (int trial = 0; trial < 300; ++trial) {
        // What is seen between two depths, however thin or near; the light anywhere, within too.
        const double far = std::exp(random.uniform(-3, 6));
        const double near = far * std::exp(random.uniform(-12, -0.01));
        std::vector<glm::dvec3> points;
        for (const double depth : {near, far})
            for (const glm::dvec2 side : {glm::dvec2(-1, -1), {-1, 1}, {1, -1}, {1, 1}})
                points.push_back(depth * glm::dvec3(0.7 * side.x, 0.5 * side.y, 1));
        const double reach = far * std::exp(random.uniform(-3, 5));
        const glm::dvec3 light =
            reach * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
        const ConvexVolume hull = pointCasterVolume(points, light);
        points.push_back(light);
        EXPECT_GE(hull.planes.size(), 5U);
        const double size = far + reach;
        for (const Plane& plane : hull.planes) {
            double minDistance = std::numeric_limits<double>::infinity();
            for (const glm::dvec3& point : points)
                minDistance = std::min(minDistance, plane.signedDistance(point));
            EXPECT_NEAR(minDistance / size, 0, 1e-12) << "a plane that can be moved in, or cuts";
        }
        for (int i = 0; i < 50; ++i) {
            glm::dvec3 mixed(0);
            double sum = 0;
            for (const glm::dvec3& point : points) {
                const double weight = -std::log(random.uniform(1e-9, 1));
                mixed += weight * point;
                sum += weight;
            }
            EXPECT_GE(depthInside(hull, mixed / sum) / size, -1e-12);
            // Beyond the light nothing stands between it and what is seen.
            const glm::dvec3 farther = light + 0.1 * (light - points[static_cast<std::size_t>(i) % 8]);
            outside += depthInside(hull, farther) < 0 ? 1 : 0;
        }
    }
    EXPECT_GT(outside, 12000);
}

/// What of the map of `image` lies `reach` from where `p` (camera space) is looked up, in texels, at depth `z` of its
/// clip space; nothing where that is past the vanishing line.
std::optional<glm::dvec3> readBeside(
    const DoubleMapImage& image, const glm::dvec3& p, const glm::dvec2& reach, double z) {
    glm::dvec4 at = image.clipFromOffset * glm::dvec4(p - image.origin, 1);
    at /= at.w;
    const glm::dvec2 further = reach / image.texelScale;
    at.x += further.x;
    at.y = image.logRows == 0 ? at.y + further.y : at.y * std::exp(-further.y);
    at.z = z;
    const glm::dvec4 offset = glm::inverse(image.clipFromOffset) * at;
    if (!(offset.w > 0)) return std::nullopt;
    return glm::dvec3(offset) / offset.w + image.origin;
}

/// The same as far as a lookup of `map` reaches, at any depth that can throw a shadow.
std::optional<glm::dvec3> randomRead(Random& random, const ShadowMap& map, const glm::dvec3& p) {
    const double limit = map.gutter * 0.999;
    const double x = random.uniform(-limit, limit);
    const double y = random.uniform(-limit, limit);
    return readBeside(cameraImage(map), p, {x, y}, random.uniform(-1, 0.999));
}

/// The grown volume must hold every caster whose texel a lookup can read: sampled through the map and back.
TEST(Casters, GrownVolumeHoldsEveryTexelThatALookupReads) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const Case chosen = randomCase(random);
        const ShadowMap& map = chosen.setup.maps[random.below(chosen.setup.maps.size())];
        // Next to a warp's centre the inverse below has no digits left; the volume is made without one.
        if (map.warped.kappa * map.warped.length > 1e4) continue;
        for (int i = 0; i < 50; ++i) {
            const FitVertex& a = map.region.vertices[random.below(map.region.vertices.size())];
            const FitVertex& b = map.region.vertices[random.below(map.region.vertices.size())];
            const glm::dvec3 p = a.position + (b.position - a.position) * random.unit();
            const std::optional<glm::dvec3> caster = randomRead(random, map, p);
            if (!caster) continue;
            ++tested;
            EXPECT_GE(
                depthInside(map.casterVolume, *caster), -1e-6 * map.region.frustum.far - 1e-6 * glm::length(*caster))
                << "seed " << seed << " kappa d " << map.warped.kappa * map.warped.length;
        }
    }
    EXPECT_GT(tested, 15000);
}

/// Where lookups at the corners of the map's region end that reach as far as they can, at the far end of the map's
/// depth (camera space); nothing where one ends past the vanishing line.
std::vector<glm::dvec3> farthestLookups(const ShadowMap& map) {
    const DoubleMapImage image = cameraImage(map);
    std::vector<glm::dvec3> lookups;
    for (const FitVertex& vertex : map.region.vertices)
        for (const glm::dvec2& way : {glm::dvec2(1, 1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(-1, -1)}) {
            const std::optional<glm::dvec3> read = readBeside(image, vertex.position, glm::dvec2(map.gutter) * way, 1);
            if (!read) return {};
            lookups.push_back(*read);
        }
    return lookups;
}

/// What holds the texels of every lookup is no larger than that: each plane of the grown volume passes through what one
/// of the region's corners reads at the end of its reach.
TEST(Casters, NoPlaneOfTheGrownVolumeCanBeMovedIn) {
    int tested = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        const Case chosen = randomCase(random);
        for (const ShadowMap& map : chosen.setup.maps) {
            if (map.warped.kappa * map.warped.length > 1e3) continue;
            const std::vector<glm::dvec3> lookups = farthestLookups(map);
            if (lookups.empty()) continue;
            double size = map.region.frustum.far;
            for (const glm::dvec3& p : lookups)
                size = std::max(size, glm::length(p));
            EXPECT_GE(map.casterVolume.planes.size(), 4U);
            for (const Plane& plane : map.casterVolume.planes) {
                double minDistance = std::numeric_limits<double>::infinity();
                for (const glm::dvec3& p : lookups)
                    minDistance = std::min(minDistance, plane.signedDistance(p));
                EXPECT_NEAR(minDistance / size, 0, 1e-6) << "seed " << seed;
                ++tested;
            }
        }
    }
    EXPECT_GT(tested, 2000);
}

/// Boxes at random in the frustum, each seen at all the depths that it spans, or at some of them.
std::vector<VisibleSlab> randomSeen(Random& random, const ShadowView& view) {
    std::vector<VisibleSlab> seen;
    const std::uint64_t count = 1 + random.below(4);
    for (std::uint64_t i = 0; i < count; ++i) {
        const glm::dvec3 middle = randomPointIn(random, view.frustum);
        const double size = middle.z * random.uniform(0.01, 1);
        glm::dvec3 half;
        for (int axis = 0; axis < 3; ++axis)
            half[axis] = random.below(4) == 0 ? 0 : size * random.unit(); // a ground is flat
        const glm::dvec3 inWorld = toWorld(view.anchor.basis, middle);
        const double reach = glm::dot(glm::abs(view.anchor.basis.view), half);
        const double seenReach = random.below(2) == 0 ? reach : reach * random.unit();
        seen.push_back({{middle.z - seenReach, middle.z + seenReach}, {inWorld - half, inWorld + half}});
    }
    return seen;
}

glm::dvec3 randomPointIn(Random& random, const Box& box) {
    glm::dvec3 point = box.min;
    const glm::dvec3 extent = box.extent();
    for (int axis = 0; axis < 3; ++axis)
        point[axis] += extent[axis] * random.unit();
    return point;
}

/// What in `map` lies beside, or before, where a seen point is looked up, as far as a lookup reaches; nothing if that
/// is past the vanishing line, or no point was found in the map's region.
std::optional<glm::dvec3> randomSeenRead(Random& random, const Case& chosen, const ShadowMap& map) {
    const VisibleSlab& part = chosen.view.seen[random.below(chosen.view.seen.size())];
    const glm::dvec3 p = toCamera(chosen.view.anchor.basis, randomPointIn(random, part.box));
    if (!contains(map.region.volume, p) || p.z < part.depths.near || p.z > part.depths.far) return std::nullopt;
    return randomRead(random, map, p);
}

/// The volume of what is seen holds every caster whose texel the lookup of a seen point can read, and nothing that the
/// volume of the whole region does not hold, but for the rare side that its growth carries past the vanishing line.
TEST(Casters, VolumeOfWhatIsSeenHoldsEveryTexelThatItReads) {
    int tested = 0;
    int narrower = 0;
    int wider = 0;
    for (std::uint64_t seed = 0; seed < 500; ++seed) {
        Random random(seed);
        Case chosen = randomCase(random);
        ShadowOptions options = randomOptions(random, chosen.view.frustum);
        options.stabilized = false;
        const ShadowMapSetup whole = shadowMapSetup(chosen.view, options);
        chosen.view.seen = randomSeen(random, chosen.view);
        const ShadowMapSetup setup = shadowMapSetup(chosen.view, options);
        const std::size_t index = random.below(setup.maps.size());
        const ShadowMap& map = setup.maps[index];
        if (map.warped.kappa * map.warped.length > 1e4) continue;
        for (int i = 0; i < 50; ++i) {
            const std::optional<glm::dvec3> point = randomSeenRead(random, chosen, map);
            if (!point) continue;
            ++tested;
            const double tolerance = 1e-6 * map.region.frustum.far + 1e-6 * glm::length(*point);
            EXPECT_GE(depthInside(map.casterVolume, *point), -tolerance) << "seed " << seed;
        }
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = randomCaster(random, map.region, map.warped.frame.y);
            const double tolerance = 1e-6 * map.region.frustum.far;
            const double inSeen = depthInside(map.casterVolume, p);
            const double inWhole = depthInside(whole.maps[index].casterVolume, p);
            wider += inSeen > tolerance && inWhole < -tolerance ? 1 : 0;
            narrower += inSeen < -tolerance && inWhole > tolerance ? 1 : 0;
        }
    }
    EXPECT_GT(tested, 3000);
    EXPECT_GT(narrower, 1000);
    EXPECT_LT(wider * 100, narrower);
}

} // namespace
} // namespace gnomon::shadow
