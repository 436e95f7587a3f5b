// Maps of a point light: a point that is seen lies in the map of its face of the cube, no texel is wider there than
// promised, whatever stands before it can cast into the map, and no plane shadows itself.
#include "shadow/cube/cube_face.h"
#include "shadow/cube/cube_maps.h"
#include "tests/support/random_point.h"
#include "tests/support/random_views.h"

#include <gtest/gtest.h>

namespace gnomon::shadow {
namespace {

/// Boxes that a view between two depths sees, a lamp among them or far beyond, and its maps.
struct LampScene {
    std::vector<VisibleSlab> seen;
    LampView view;
    ShadowOptions options;
    ShadowMapSetup setup;

    explicit LampScene(std::uint64_t seed) {
        Random random(seed);
        Camera camera;
        camera.target = randomDirection(random);
        camera.up = randomDirection(random);
        view.basis = cameraBasis(camera);
        const double far = std::exp2(10 * random.unit());
        view.frustum = {far / std::exp2(1 + 8 * random.unit()), far, 0.1 + random.unit(), 0.5 + 1.5 * random.unit()};
        view.shown = {view.frustum.near * (random.below(2) == 0 ? 1 : 0.5), far * (random.below(2) == 0 ? 1 : 1.5)};
        view.imageHeight = 100 + static_cast<int>(random.below(900));
        const double reach = random.below(4) == 0 ? 1e4 * far : 0.7 * far;
        view.light = glm::dvec3(0, 0, far / 2) + reach * random.unit() * randomDirection(random);
        options.texels = 1 << (14 + random.below(9));
        options.filterTexels = random.below(3) == 0 ? 3 : 0;
        for (double near = view.shown.near; near < view.shown.far; near *= 1.3) {
            if (random.below(3) == 0) continue;
            const DepthSpan depths{near, std::min(near * 1.3, view.shown.far)};
            Box all;
            for (const glm::dvec3& corner : corners(slice(view.frustum, depths.near, depths.far)))
                all.add(toWorld(view.basis, corner));
            const glm::dvec3 a = randomPoint(random, all);
            const glm::dvec3 b = randomPoint(random, all);
            seen.push_back({depths, {glm::min(a, b), glm::max(a, b)}});
        }
        if (random.below(5) != 0) view.seen = seen;
        setup = cubeMapSetup(view, options);
    }

    /// A point that is seen, in camera space; nothing if this try finds none.
    std::optional<glm::dvec3> seenPoint(Random& random) const {
        if (seen.empty()) return std::nullopt;
        const VisibleSlab& part = seen[random.below(seen.size())];
        const glm::dvec3 p = toCamera(view.basis, randomPoint(random, part.box));
        const bool isIn = p.z >= part.depths.near && p.z <= part.depths.far &&
                          std::abs(p.x) <= tanHalfX(view.frustum) * p.z &&
                          std::abs(p.y) <= tanHalfY(view.frustum) * p.z;
        return isIn ? std::optional(p) : std::nullopt;
    }

    const ShadowMap* mapOf(const glm::dvec3& p) const {
        const std::size_t face = cubeFaceOf(toWorld(view.basis, p - view.light));
        return setup.mapOfPartition[face] == ShadowMapSetup::kNoMap ? nullptr : &setup.maps[setup.mapOfPartition[face]];
    }
};

/// The widths of a texel along the face's axes at `p`, by finite differences of the matrix of lookups.
glm::dvec2 texelWidths(const ShadowMap& map, const glm::dvec3& p) {
    const DoubleMapImage image = cameraImage(map);
    const double h = 1e-5 * glm::length(p - map.cubeFace->light);
    const auto perUnit = [&](const glm::dvec3& axis) {
        const MapTexel<double> a = texelAt(image, p - h * axis);
        const MapTexel<double> b = texelAt(image, p + h * axis);
        return glm::length(glm::dvec2(b.column - a.column, b.row - a.row)) / (2 * h);
    };
    return {1 / perUnit(map.cubeFace->frame.x), 1 / perUnit(map.cubeFace->frame.z)};
}

TEST(CubeMaps, HoldWhatIsSeenAndPromiseTheWidthOfItsTexels) {
    int measured = 0;
    int tight = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        const LampScene scene(seed);
        Random random(seed + 1000);
        double max = 0; // of the share of its promise that any point has
        for (int i = 0; i < 400; ++i) {
            const std::optional<glm::dvec3> p = scene.seenPoint(random);
            if (!p) continue;
            const ShadowMap* map = scene.mapOf(*p);
            ASSERT_NE(map, nullptr) << seed;
            const MapTexel<double> at = texelAt(cameraImage(*map), *p);
            const TexelRectangle inner = map->innerRectangle();
            ASSERT_TRUE(at.w > 0 && at.w <= map->cubeFace->far && at.depth <= 1) << seed;
            ASSERT_TRUE(at.column >= inner.x - 1e-3 && at.column <= inner.x + inner.width + 1e-3) << seed;
            ASSERT_TRUE(at.row >= inner.y - 1e-3 && at.row <= inner.y + inner.height + 1e-3) << seed;
            if (p->z < scene.view.frustum.near || p->z > scene.view.frustum.far) continue;
            const double pixel = imageBeamWidth(scene.view.frustum, p->z, scene.view.imageHeight);
            const glm::dvec2 widths = texelWidths(*map, *p) * std::max(1.0, scene.options.filterTexels) / pixel;
            ASSERT_LE(widths.x, map->aliasingBound.x * (1 + 1e-4)) << seed;
            ASSERT_LE(widths.y, map->aliasingBound.z * (1 + 1e-4)) << seed;
            max = std::max(max, widths.x / map->aliasingBound.x);
            ++measured;
        }
        tight += max > 0.5 ? 1 : 0;
    }
    EXPECT_GT(measured, 10000);
    EXPECT_GT(tight, 100); // not a bound of anything, either
}

TEST(CubeMaps, TakeInAllThatStandsBeforeTheLight) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const LampScene scene(seed);
        Random random(seed + 2000);
        for (int i = 0; i < 100; ++i) {
            const std::optional<glm::dvec3> p = scene.seenPoint(random);
            if (!p) continue;
            const ShadowMap* map = scene.mapOf(*p);
            ASSERT_NE(map, nullptr) << seed;
            const glm::dvec3 caster = glm::mix(scene.view.light, *p, random.unit());
            const double slack = 1e-9 * (glm::length(scene.view.light) + scene.view.shown.far);
            for (const Plane& plane : map->casterVolume.planes)
                EXPECT_GE(plane.signedDistance(caster), -slack) << seed;
        }
    }
}

/// The depth of the plane through `p` where the way from the light through a texel meets it that lies as far from the
/// one of `p` as a lookup reaches, to the sides that `signs` tell; infinite where it does not.
double storedAt(const ShadowMap& map, const glm::dvec3& p, const glm::dvec3& normal, const glm::dvec2& signs) {
    const DoubleMapImage image = cameraImage(map);
    const MapTexel<double> at = texelAt(image, p);
    const glm::dvec2 texel = glm::dvec2(at.column, at.row) + (image.reach - 1.0 / 256) * signs;
    const glm::dvec2 there = (texel - image.texelOffset) / image.texelScale;
    const glm::dvec4 far = glm::inverse(image.clipFromOffset) * glm::dvec4(there, 1, 1);
    const glm::dvec3 light = map.cubeFace->light;
    const glm::dvec3 ray = glm::dvec3(far) / far.w + image.origin - light;
    const double slope = glm::dot(normal, ray);
    if (!(slope < 0)) return std::numeric_limits<double>::infinity();
    return texelAt(image, light + glm::dot(normal, p - light) / slope * ray).depth;
}

TEST(CubeMaps, LetNoPlaneShadowItselfOverTheReachOfALookup) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const LampScene scene(seed);
        Random random(seed + 3000);
        for (int i = 0; i < 100; ++i) {
            const std::optional<glm::dvec3> p = scene.seenPoint(random);
            if (!p) continue;
            const ShadowMap& map = *scene.mapOf(*p);
            const glm::dvec3 towards = glm::normalize(scene.view.light - *p);
            glm::dvec3 normal = randomDirection(random);
            if (glm::dot(normal, towards) < 0) normal = -normal;
            const double cosine = glm::dot(normal, towards);
            if (cosine < kMinCosine) continue;
            const DoubleMapImage image = cameraImage(map);
            const MapTexel<double> at = texelAt(image, *p);
            const double biased = at.depth - receiverBias(image, *p, normal, cosine);
            const double side = random.below(2) == 0 ? -1 : 1;
            const double other = random.below(2) == 0 ? -1 : 1;
            const double stored = storedAt(map, *p, normal, {side, other});
            EXPECT_LE(biased, stored) << seed << " cosine " << cosine;
        }
    }
}

TEST(CubeMaps, AreOfFacesThatAnythingIsSeenThrough) {
    LampScene scene(7);
    scene.view.light = {0, 0, 0}; // the eye
    scene.view.frustum = {1, 10, 0.3, 1};
    scene.view.shown = {1, 10};
    scene.view.basis = cameraBasis(Camera{});
    scene.view.seen = {};
    const ShadowMapSetup setup = cubeMapSetup(scene.view, scene.options);
    ASSERT_EQ(setup.maps.size(), 1U); // the view's whole width lies within one face
    EXPECT_EQ(setup.maps.front().region.face, Face::MinusZ);
    EXPECT_NEAR(setup.maps.front().cubeFace->sRange, 2 * std::tan(0.3), 0.1);
    EXPECT_STREQ(name(Face::MinusZ), "-z");
    // A texel and a pixel are cones from the same point, so the promise is as good as alike everywhere.
    const double critical = scene.view.imageHeight * std::max(1.0, scene.options.filterTexels);
    EXPECT_NEAR(setup.worst().x * setup.maps.front().texels().s, critical, 0.1 * critical);
    for (std::size_t face = 0; face < kCubeFaces.size(); ++face)
        EXPECT_EQ(cubeFaceOf(-cubeFaceAxes(face).y), face);
}

} // namespace
} // namespace gnomon::shadow
