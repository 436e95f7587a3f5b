// Rays against testing every triangle in doubles.
#include "core/random.h"
#include "raytrace/ray.h"
#include "raytrace/scene.h"
#include "tests/support/tiny_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::raytrace {
namespace {

struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    double clearance = std::numeric_limits<double>::infinity(); // of the ray from any edge that it passes
    std::uint32_t page = 0;
    std::uint32_t triangle = 0;
};

/// A ray in doubles.
struct Line {
    glm::dvec3 origin, direction;
};

/// Moeller and Trumbore (1997).
void intersect(
    const Line& ray,
    const std::array<glm::dvec3, 3>& corners,
    std::uint32_t page,
    std::uint32_t triangle,
    Nearest& best) {
    const glm::dvec3& a = corners[0];
    const glm::dvec3 e1 = corners[1] - a;
    const glm::dvec3 e2 = corners[2] - a;
    const glm::dvec3 p = glm::cross(ray.direction, e2);
    const double det = glm::dot(e1, p);
    if (det == 0) return;
    const glm::dvec3 q = glm::cross(ray.origin - a, e1);
    const double u = glm::dot(ray.origin - a, p) / det;
    const double v = glm::dot(ray.direction, q) / det;
    const double distance = glm::dot(e2, q) / det;
    if (distance < 0) return;
    const double inside = std::min({u, v, 1 - u - v});
    best.clearance = std::min(best.clearance, std::abs(inside));
    if (inside >= 0 && distance < best.distance) {
        best.distance = distance;
        best.page = page;
        best.triangle = triangle;
    }
}

void intersectCluster(
    const Line& ray,
    const hierarchy::Page& page,
    std::uint32_t c,
    const hierarchy::Grid& grid,
    std::uint32_t s,
    Nearest& best) {
    const hierarchy::Cluster& cluster = page.clusters[c];
    for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
        const auto corner = [&](std::size_t i) {
            return grid.local(page.vertices[cluster.firstVertex + page.triangles[t][i]].position);
        };
        intersect(ray, {corner(0), corner(1), corner(2)}, s, t, best);
    }
}

/// Every triangle of every given span.
Nearest bruteForce(
    std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& from, const glm::dvec3& along) {
    Nearest best;
    for (std::uint32_t s = 0; s < spans.size(); ++s) {
        for (std::uint32_t c = spans[s].firstCluster; c < spans[s].firstCluster + spans[s].clusterCount; ++c)
            intersectCluster({from, along}, *spans[s].page, c, grid, s, best);
    }
    return best;
}

std::vector<ClusterSpan> finestLevel(const tests::TinyModel& model) {
    std::vector<ClusterSpan> spans;
    for (const hierarchy::Page& page : model.pages)
        if (page.level == 0) spans.push_back({&page, 0, static_cast<std::uint32_t>(page.clusters.size())});
    return spans;
}

TEST(Scene, HitsWhatBruteForceHits) {
    tests::TinyModelOptions options;
    options.gridExponent = 4;
    options.clusterTriangles = 16;
    const tests::TinyModel model = tests::makeTinyModel(options);
    const std::vector<ClusterSpan> spans = finestLevel(model);
    const glm::dvec3 eye(3, 7, 2);
    const Scene scene(spans, model.summary.grid, eye);
    EXPECT_EQ(scene.triangleCount(), model.summary.levels[0].triangles);
    Random random(71);
    std::vector<Ray> rays;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 from(random.uniform(-5, 20), random.uniform(-2, 10), random.uniform(-5, 20));
        const glm::dvec3 to(random.uniform(0, 16), random.uniform(0, 3), random.uniform(0, 16));
        rays.push_back({glm::vec3(from - eye), glm::vec3(glm::normalize(to - from))});
    }
    const std::vector<std::uint8_t> occluded = scene.occlusion(rays);
    int compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from = eye + glm::dvec3(rays[i].origin);
        const Nearest truth = bruteForce(spans, model.summary.grid, from, glm::dvec3(rays[i].direction));
        if (truth.clearance < 1e-4) continue; // grazes an edge: either answer is right
        ++compared;
        const bool isHit = std::isfinite(truth.distance);
        EXPECT_EQ(occluded[i] != 0, isHit);
        const std::optional<Hit> hit = scene.firstHit(rays[i]);
        ASSERT_EQ(hit.has_value(), isHit);
        if (!isHit) continue;
        EXPECT_NEAR(static_cast<double>(hit->distance), truth.distance, 1e-4);
        EXPECT_EQ(hit->span, truth.page);
        EXPECT_EQ(hit->triangle, truth.triangle);
        EXPECT_LE(glm::dot(hit->normal, rays[i].direction), 0);
        const hierarchy::Cluster& cluster = spans[hit->span].page->clusters[hit->cluster];
        EXPECT_GE(hit->triangle, cluster.firstTriangle);
        EXPECT_LT(hit->triangle, cluster.firstTriangle + cluster.triangleCount);
    }
    EXPECT_GT(compared, 1500);
}

bool isInside(const std::vector<Plane>& planes, const glm::dvec3& p) {
    return std::all_of(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.signedDistance(p) >= 0; });
}

// Point by point along rays, inside all planes or not.
TEST(KeptPart, IsWhatLiesOnTheInnerSideOfAllPlanes) {
    Random random(73);
    const auto inSphere = [&] {
        return glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    };
    int kept = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<Plane> planes;
        for (std::uint64_t i = 0; i < random.below(4); ++i)
            planes.push_back(
                {trial % 5 == 0 ? glm::dvec3(0, 1, 0) : glm::normalize(inSphere()), random.uniform(-1, 1)});
        Ray ray{glm::vec3(2.0 * inSphere()), glm::vec3(glm::normalize(inSphere())), 0.25F, 6};
        if (trial % 7 == 0) ray.direction = {1, 0, 0};
        const std::optional<Ray> part = keptPart(ray, planes);
        for (float at = 0.3F; at < 6; at += 0.1F) {
            const glm::dvec3 p(ray.origin + at * ray.direction);
            const bool isNearBorder = std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
                return std::abs(plane.signedDistance(p)) < 1e-5;
            });
            if (isNearBorder) continue;
            EXPECT_EQ(part && at >= part->tMin && at <= part->tMax, isInside(planes, p)) << trial << " at " << at;
            kept += isInside(planes, p) ? 1 : 0;
        }
        if (!part) continue;
        EXPECT_GE(part->tMin, ray.tMin);
        EXPECT_LE(part->tMax, ray.tMax);
        EXPECT_EQ(part->origin, ray.origin);
    }
    EXPECT_GT(kept, 20000);
}

// As if the triangles had been cut: what lies beyond is not met, and is in the way only where occluders are whole.
TEST(Scene, IsCutByPlanes) {
    tests::TinyModelOptions options;
    options.gridExponent = 4;
    const tests::TinyModel model = tests::makeTinyModel(options);
    const std::vector<ClusterSpan> spans = finestLevel(model);
    const glm::dvec3 eye(3, 7, 2);
    const Scene whole(spans, model.summary.grid, eye);
    Scene cut(spans, model.summary.grid, eye);
    Random random(74);
    int changed = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        const glm::dvec3 normal(random.uniform(-1, 1), random.uniform(-0.2, 0.2), random.uniform(-1, 1));
        const std::vector<Plane> planes = {{glm::normalize(normal), random.uniform(-4, 4)}};
        cut.cutBy(planes, trial % 2 == 0);
        const glm::dvec3 from(random.uniform(-5, 20), random.uniform(-2, 10), random.uniform(-5, 20));
        const glm::dvec3 to(random.uniform(0, 16), random.uniform(0, 3), random.uniform(0, 16));
        const Ray ray{glm::vec3(from - eye), glm::vec3(glm::normalize(to - from))};
        // The next hit of the whole that is kept.
        std::optional<Hit> truth = whole.firstHit(ray);
        while (truth && !isInside(planes, glm::dvec3(ray.origin + truth->distance * ray.direction))) {
            Ray behind = ray;
            behind.tMin = truth->distance + 1e-3F;
            truth = whole.firstHit(behind);
            ++changed;
        }
        const std::optional<Hit> hit = cut.firstHit(ray);
        ASSERT_EQ(hit.has_value(), truth.has_value()) << trial;
        if (hit) {
            EXPECT_NEAR(static_cast<double>(hit->distance), static_cast<double>(truth->distance), 1e-4) << trial;
        }
        EXPECT_EQ(cut.isOccluded(ray), trial % 2 == 0 ? truth.has_value() : whole.isOccluded(ray)) << trial;
    }
    EXPECT_GT(changed, 200);
}

TEST(Scene, WithoutClustersIsEmpty) {
    const Scene scene({}, hierarchy::Grid{}, glm::dvec3(0));
    EXPECT_EQ(scene.triangleCount(), 0U);
    EXPECT_FALSE(scene.firstHit({}).has_value());
    EXPECT_FALSE(scene.isOccluded({}));
}

// A million units from the origin, floats relative to the eye still place a hit to a thousandth.
TEST(Scene, IsExactFarFromTheOrigin) {
    tests::TinyModelOptions options;
    options.gridExponent = 4;
    tests::TinyModel model = tests::makeTinyModel(options);
    for (hierarchy::Page& page : model.pages)
        for (hierarchy::Vertex& vertex : page.vertices)
            vertex.position.x += 1U << 30U;
    const std::vector<ClusterSpan> spans = finestLevel(model);
    const double shift = std::ldexp(1.0, 30 + model.summary.grid.stepExponent);
    const glm::dvec3 eye(shift + 8, 20, 8);
    const Scene scene(spans, model.summary.grid, eye);
    Random random(72);
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 to(random.uniform(1, 15), 0, random.uniform(1, 15));
        const glm::dvec3 along = glm::normalize(to - glm::dvec3(8, 20, 8));
        const glm::vec3 direction(along);
        const Nearest truth = bruteForce(spans, model.summary.grid, eye, glm::dvec3(direction));
        if (truth.clearance < 1e-4) continue;
        ++compared;
        const std::optional<Hit> hit = scene.firstHit({glm::vec3(0), direction});
        ASSERT_TRUE(hit.has_value());
        EXPECT_NEAR(static_cast<double>(hit->distance), truth.distance, 1e-3);
    }
    EXPECT_GT(compared, 50);
}

} // namespace
} // namespace gnomon::raytrace
