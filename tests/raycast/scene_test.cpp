// Rays against testing every triangle in doubles.
#include "core/random.h"
#include "hierarchy/tiny_model.h"
#include "raycast/ray.h"
#include "raycast/scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace gnomon::raycast {
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
void meet(
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

void meetCluster(
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
        meet(ray, {corner(0), corner(1), corner(2)}, s, t, best);
    }
}

/// Every triangle of every given span.
Nearest bruteForce(
    std::span<const ClusterSpan> spans, const hierarchy::Grid& grid, const glm::dvec3& from, const glm::dvec3& along) {
    Nearest best;
    for (std::uint32_t s = 0; s < spans.size(); ++s) {
        for (std::uint32_t c = spans[s].firstCluster; c < spans[s].firstCluster + spans[s].clusterCount; ++c)
            meetCluster({from, along}, *spans[s].page, c, grid, s, best);
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
    const std::vector<std::optional<Hit>> hits = scene.firstHits(rays);
    const std::vector<std::uint8_t> occluded = scene.occlusion(rays);
    int compared = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 from = eye + glm::dvec3(rays[i].origin);
        const Nearest truth = bruteForce(spans, model.summary.grid, from, glm::dvec3(rays[i].direction));
        if (truth.clearance < 1e-4) continue; // grazes an edge: either answer is right
        ++compared;
        const bool isHit = std::isfinite(truth.distance);
        EXPECT_EQ(occluded[i] != 0, isHit);
        ASSERT_EQ(hits[i].has_value(), isHit);
        if (!isHit) continue;
        EXPECT_NEAR(static_cast<double>(hits[i]->distance), truth.distance, 1e-4);
        EXPECT_EQ(hits[i]->span, truth.page);
        EXPECT_EQ(hits[i]->triangle, truth.triangle);
        EXPECT_LE(glm::dot(hits[i]->normal, rays[i].direction), 0);
        const hierarchy::Cluster& cluster = spans[hits[i]->span].page->clusters[hits[i]->cluster];
        EXPECT_GE(hits[i]->triangle, cluster.firstTriangle);
        EXPECT_LT(hits[i]->triangle, cluster.firstTriangle + cluster.triangleCount);
    }
    EXPECT_GT(compared, 1500);
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
} // namespace gnomon::raycast
