// Counts the errors of ray-traced shadows (Embree, float arithmetic) against exact integer arithmetic.
//
// usage: ray_truth MODEL.gnm VIEWS [SIDE]
//
// The first test draws VIEWS seeded views with SIDE x SIDE pixels (default: 256). It counts pixels whose shadow differs
// from a brute-force test with integers, for exact shadows and for ray-traced shadows.
//
// The second test traces 150,000 rays through triangles of full detail: inside, on an edge, or through a corner. It
// counts rays whose hit differs from the integer result. It runs with the eye at the triangles and 2^20 grid cells
// away.
#include "core/error.h"
#include "frame/renderer.h"
#include "render/exact_pass.h"
#include "render/software_backend.h"
#include "tests/exact/random.h"
#include "tests/support/shadow_triples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace gnomon {
namespace {

using exact::Corners;
using exact::RandomWholes;

/// Returns true if at least half of the light reaches the surface.
bool isLit(const render::SurfaceSample& surface) {
    return surface.isLitSide() && surface.litFraction() >= 0.5F;
}

/// A frame, and one entry per pixel that is true if the pixel is lit.
struct Shot {
    frame::PreparedFrame frame;
    std::vector<bool> lit;
};

/// Draws the view of `triple` with the shadow method `shadows`.
Shot drawn(frame::Renderer& renderer, const tests::ShadowTriple& triple, plan::ShadowMode shadows) {
    plan::Quality quality;
    quality.shadows = shadows;
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    Shot shot{renderer.prepare(triple.view, quality), {}};
    renderer.draw(shot.frame, options);
    for (const render::SurfaceSample& surface : renderer.backend().surfaces().pixels)
        shot.lit.push_back(isLit(surface));
    return shot;
}

/// Draws `count` seeded views of the model with exact shadows and with ray-traced shadows. Prints the number of pixels
/// that differ from the brute-force integer result.
void compareViews(const hierarchy::ModelFile& model, std::uint64_t count, int side) {
    const std::unique_ptr<render::Backend> backend = render::makeSoftwareBackend();
    frame::Renderer renderer(model, *backend, {.memory = gibibytes(4), .onDamaged = {}});
    std::uint64_t pixels = 0;
    std::uint64_t wrongExact = 0;
    std::uint64_t falselyDark = 0;
    std::uint64_t falselyLit = 0;
    std::uint64_t dark = 0;
    std::uint64_t views = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
        const tests::ShadowTriple triple = tests::shadowTriple(model.summary().bounds, i, side, 256);
        const Shot rays = drawn(renderer, triple, plan::ShadowMode::Rays);
        const Shot decided = drawn(renderer, triple, plan::ShadowMode::Exact);
        if (!decided.frame.isExact()) continue;
        render::DrawInputs drawing = renderer.drawing(decided.frame, {});
        drawing.exactCasters = &decided.frame.cut.lists.casters[0];
        const render::Raster<std::uint8_t> truth = render::litByIntegers(drawing);
        ++views;
        pixels += truth.pixels.size();
        for (std::size_t p = 0; p < truth.pixels.size(); ++p) {
            const bool isTrulyLit = truth.pixels[p] != 0;
            wrongExact += decided.lit[p] != isTrulyLit ? 1U : 0U;
            falselyDark += isTrulyLit && !rays.lit[p] ? 1U : 0U;
            falselyLit += !isTrulyLit && rays.lit[p] ? 1U : 0U;
            dark += isTrulyLit ? 0U : 1U;
        }
    }
    std::printf(
        "%lu views, %lu pixels, %lu not lit: wrong in exact shadows %lu; by rays %lu falsely dark, %lu falsely lit\n",
        views,
        pixels,
        dark,
        wrongExact,
        falselyDark,
        falselyLit);
}

/// The clusters of one group at full detail, and their triangles relative to an origin.
struct Surface {
    std::vector<Corners> triangles;
    raytrace::PageClusters clusters;
};

Surface surfaceOf(const hierarchy::Page& page, const hierarchy::Group& group, const hierarchy::GridPoint& origin) {
    Surface surface{{}, {0, {&page, group.firstCluster, group.clusterCount}}};
    for (std::uint32_t c = group.firstCluster; c < group.firstCluster + group.clusterCount; ++c) {
        const hierarchy::Cluster& cluster = page.clusters[c];
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
            Corners corners;
            for (std::size_t k = 0; k < 3; ++k) {
                const hierarchy::GridPoint& p = page.vertices[cluster.firstVertex + page.triangles[t][k]].position;
                corners[k] = glm::i64vec3(p.x, p.y, p.z) - glm::i64vec3(origin.x, origin.y, origin.z);
            }
            surface.triangles.push_back(corners);
        }
    }
    return surface;
}

/// Each triangle that a ray hits stops the ray.
class AnyStops final : public raytrace::HitRule {
public:
    bool stops(std::uint32_t /*ray*/, const raytrace::PageTriangle& /*triangle*/) const override { return true; }
};

/// Returns a point of the triangle `corners`, multiplied by 2^24. The point is inside the triangle (`kind` 0), on an
/// edge (1), or at a corner (2).
glm::i64vec3 pointOf(const Corners& corners, int kind, RandomWholes& random) {
    constexpr std::int64_t kOne = std::int64_t{1} << exact::kWeightBits;
    const std::int64_t b = kind == 2 ? 0 : random.whole(1, kOne - 2);
    const std::int64_t c = kind == 0 ? random.whole(1, kOne - 1 - b) : 0;
    return corners[0] * kOne + (corners[1] - corners[0]) * b + (corners[2] - corners[0]) * c;
}

/// The number of rays of one kind (inside, edge or corner), and the number of wrong float results.
struct TieCounts {
    std::uint64_t rays = 0;
    std::uint64_t hit = 0;    // rays that hit only with floats
    std::uint64_t passed = 0; // rays that hit only with integers
    // Wrong results far from an edge of the surface: rays 2^-10 cells away have the same integer result.
    std::uint64_t inTheMidst = 0;
};

/// Returns true if the ray from `point` to the light hits a triangle of `surface`, computed with integers.
bool isHitByIntegers(const Surface& surface, const IntegerLight& light, const glm::i64vec3& point) {
    return std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const Corners& each) {
        return exact::intersect(each, light, point, 0).kind == exact::Hit::Ahead;
    });
}

/// Returns true if the rays from eight points around `point` all have the result `isHit`, computed with integers.
bool isSameAround(const Surface& surface, const IntegerLight& light, const glm::i64vec3& point, const bool isHit) {
    constexpr std::int64_t kOff = 1 << 14; // 2^-10 cells
    for (unsigned i = 0; i < 8; ++i) {
        const auto off = [&](unsigned bit) { return (i >> bit & 1U) != 0 ? kOff : -kOff; };
        if (isHitByIntegers(surface, light, point + glm::i64vec3(off(0), off(1), off(2))) != isHit) return false;
    }
    return true;
}

/// Traces 1500 rays towards random lights, and adds the results to `counts`. Each ray goes through a random point of a
/// triangle: inside, on an edge, or at a corner. A ray begins 16 to 65,536 cells before this point.
void compareTies(
    const Surface& surface,
    const hierarchy::GridPoint& origin,
    RandomWholes& random,
    std::array<TieCounts, 3>& counts) {
    raytrace::KeptTrees trees;
    const hierarchy::Grid cells;
    const raytrace::CutScene scene(trees, {&surface.clusters, 1}, cells, origin);
    const AnyStops rule;
    for (int i = 0; i < 1500; ++i) {
        const int kind = i % 3;
        glm::dvec3 towards(random.real(-1, 1), random.real(-1, 1), random.real(-1, 1));
        const IntegerLight light = roundedLight(towards);
        const auto at =
            static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(surface.triangles.size()) - 1));
        const glm::i64vec3 point =
            pointOf(surface.triangles[at], kind, random) - light.direction * random.whole(16, 1 << 16);
        const bool isDark = isHitByIntegers(surface, light, point);
        raytrace::Ray ray;
        ray.origin = glm::vec3(glm::dvec3(point) * 0x1p-24);
        ray.direction = glm::vec3(glm::dvec3(light.direction) * 0x1p-24);
        const bool isHit = scene.isStopped(ray, 0, rule);
        TieCounts& count = counts.at(static_cast<std::size_t>(kind));
        ++count.rays;
        if (isHit == isDark) continue;
        ++(isHit ? count.hit : count.passed);
        count.inTheMidst += isSameAround(surface, light, point, isDark) ? 1U : 0U;
    }
}

/// Traces rays through 100 random groups of full detail, and prints the counts. The eye is `away` cells from the group,
/// and float coordinates are relative to the eye.
void compareAllTies(const hierarchy::ModelFile& model, const std::int64_t away) {
    RandomWholes random(7);
    std::array<TieCounts, 3> counts{};
    std::vector<std::uint32_t> finest;
    for (std::uint32_t p = 0; p < model.pages().size(); ++p)
        if (model.pages()[p].level == 0) finest.push_back(p);
    for (int i = 0; i < 100; ++i) {
        const auto pick = [&](std::size_t count) {
            return static_cast<std::size_t>(random.whole(0, static_cast<std::int64_t>(count) - 1));
        };
        const hierarchy::Page page = model.readPage(finest[pick(finest.size())]);
        const hierarchy::Group& group = page.groups[pick(page.groups.size())];
        hierarchy::GridPoint origin = group.box.min;
        origin.x += static_cast<std::uint32_t>(away);
        compareTies(surfaceOf(page, group, origin), origin, random, counts);
    }
    constexpr std::array kKinds = {"inside triangles", "on edges", "in corners"};
    for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
        const TieCounts& count = counts.at(kind);
        std::printf(
            "eye %ld cells away, %s: %lu rays, %lu falsely met, %lu falsely passed; %lu in the midst\n",
            away,
            kKinds.at(kind),
            count.rays,
            count.hit,
            count.passed,
            count.inTheMidst);
    }
}

int run(int count, char** words) {
    if (count < 3) {
        std::fprintf(stderr, "usage: ray_truth MODEL.gnm VIEWS [SIDE]\n");
        return 2;
    }
    const hierarchy::ModelFile model(words[1]);
    compareViews(model, std::strtoull(words[2], nullptr, 10), count > 3 ? std::atoi(words[3]) : 256);
    for (const std::int64_t away : {0, 1 << 20})
        compareAllTies(model, away);
    return 0;
}

} // namespace
} // namespace gnomon

int main(int count, char** words) {
    try {
        return gnomon::run(count, words);
    } catch (const gnomon::Error& error) {
        std::fprintf(stderr, "ray_truth: %s\n", error.what());
        return 1;
    }
}
