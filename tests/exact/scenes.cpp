#include "tests/exact/scenes.h"

#include "exact/plain_shadows.h"
#include "exact/point_predicate.h"
#include "tests/support/each_target.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace gnomon::exact {

namespace {

constexpr std::uint32_t kTriangleBits = 8;

std::size_t countOf(const std::vector<std::uint8_t>& statuses, std::uint8_t bits) {
    return static_cast<std::size_t>(
        std::count_if(statuses.begin(), statuses.end(), [&](std::uint8_t status) { return (status & bits) != 0; }));
}

std::size_t withinToleranceOf(const std::vector<std::uint8_t>& statuses) {
    return static_cast<std::size_t>(std::count_if(
        statuses.begin(), statuses.end(), [](std::uint8_t status) { return status != kLit && status != kDark; }));
}

} // namespace

std::uint32_t Scene::add(const std::vector<Corners>& triangles) {
    std::vector<glm::i64vec3> vertices;
    std::vector<raster::Triangle> indices;
    for (const Corners& corners : triangles) {
        const auto first = static_cast<std::uint8_t>(vertices.size());
        indices.push_back({first, static_cast<std::uint8_t>(first + 1), static_cast<std::uint8_t>(first + 2)});
        vertices.insert(vertices.end(), corners.begin(), corners.end());
    }
    return add(vertices, indices);
}

std::uint32_t Scene::add(const std::vector<glm::i64vec3>& vertices, const std::vector<raster::Triangle>& triangles) {
    const auto first = static_cast<std::uint32_t>(clusters_.size() << kTriangleBits);
    Cluster cluster{vertices, {}, triangles};
    for (const glm::i64vec3& vertex : vertices)
        cluster.positions.push_back(glm::uvec3(vertex) + originCell);
    clusters_.push_back(std::move(cluster));
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
        names_.push_back(first + i);
    return first;
}

Corners Scene::corners(std::uint32_t triangle) const {
    const Cluster& cluster = clusters_[triangle >> kTriangleBits];
    const raster::Triangle& indices = cluster.triangles[triangle & ((1U << kTriangleBits) - 1)];
    return {cluster.vertices[indices[0]], cluster.vertices[indices[1]], cluster.vertices[indices[2]]};
}

std::vector<Caster> Scene::casters() const {
    std::vector<Caster> casters;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
        const Cluster& cluster = clusters_[i];
        Caster caster;
        caster.geometry.positions = &cluster.positions[0].x;
        caster.geometry.vertexCount = static_cast<std::uint32_t>(cluster.vertices.size());
        caster.geometry.triangles = cluster.triangles;
        caster.geometry.firstTriangleId = static_cast<std::uint32_t>(i << kTriangleBits);
        caster.min = caster.max = cluster.vertices[0];
        for (const glm::i64vec3& vertex : cluster.vertices) {
            caster.min = glm::min(caster.min, vertex);
            caster.max = glm::max(caster.max, vertex);
        }
        casters.push_back(caster);
    }
    return casters;
}

SceneBatch::SceneBatch(const Scene& scene, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        const ScenePoint& point = scene.points[i];
        const Corners corners = scene.corners(point.triangle);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto k = static_cast<int>(axis);
            edges_[axis][i - begin] = static_cast<std::int32_t>(corners[0][k]);
            edges_[3 + axis][i - begin] = static_cast<std::int32_t>(corners[1][k] - corners[0][k]);
            edges_[6 + axis][i - begin] = static_cast<std::int32_t>(corners[2][k] - corners[0][k]);
        }
        second_[i - begin] = point.second;
        third_[i - begin] = point.third;
        map_[i - begin] = point.map;
        pixel_[i - begin] = static_cast<std::uint32_t>(i);
        triangle_[i - begin] = point.triangle;
        tolerance_[i - begin] = point.tolerance;
    }
    batch_.count = end - begin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        batch_.corner[axis] = edges_[axis].data();
        batch_.edge1[axis] = edges_[3 + axis].data();
        batch_.edge2[axis] = edges_[6 + axis].data();
    }
    batch_.second = second_.data();
    batch_.third = third_.data();
    batch_.map = map_.data();
    batch_.pixel = pixel_.data();
    batch_.triangle = triangle_.data();
    batch_.tolerance = tolerance_.data();
}

void fill(SampleList& samples, const Scene& scene, const SampleSpace& space) {
    samples.reset(space, scene.points.size());
    constexpr std::size_t kBatch = 101; // no multiple of anything
    for (std::size_t begin = 0; begin < scene.points.size(); begin += kBatch)
        samples.add(SceneBatch(scene, begin, std::min(begin + kBatch, scene.points.size())).batch());
}

SampleSpace spaceOf(const IntegerLight& light, const glm::dvec3& eye, int maps) {
    return {light, shearAlong(light), eye, maps, std::nullopt};
}

std::vector<std::uint8_t> plainStatuses(const SampleList& samples, const Scene& scene) {
    std::vector<std::uint8_t> statuses(samples.size(), kLit);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const glm::i64vec3 point =
            scaledPoint({scene.corners(samples.triangle[i]), samples.second[i], samples.third[i]});
        for (const std::uint32_t name : scene.names()) {
            const SampleSpace& space = samples.space();
            const RayHit hit = space.pointLight
                                   ? intersectTowards(scene.corners(name), *space.pointLight, point)
                                   : intersect(scene.corners(name), space.light, point, samples.tolerance[i]);
            if (hit.kind == Hit::None) continue;
            statuses[i] |= hit.kind == Hit::WithinTolerance ? kWithinTolerance : hit.isOnEdge ? kDarkByEdge : kDark;
        }
        if ((statuses[i] & kDark) != 0) statuses[i] = kDark;
    }
    return statuses;
}

ExactStatistics expectSameAsPlain(
    const Scene& scene, const SampleSpace& space, const std::vector<glm::dmat3>& planes, int side) {
    ExactShadows shadows;
    fill(shadows.samples(), scene, space);
    const std::vector<std::uint8_t> plain = plainStatuses(shadows.samples(), scene);
    const std::vector<Caster> casters = scene.casters();
    EXPECT_EQ(plainStatuses(shadows.samples(), casters, scene.originCell), plain) << "by buckets";
    ExactStatistics last;
    tests::onEachTarget([&](const char* target) {
        std::uint64_t decisions = 0; // depend on the instruction set
        for (const int threads : {1, 2}) {
            SCOPED_TRACE(std::string(target) + ", threads " + std::to_string(threads));
            fill(shadows.samples(), scene, space);
            const ExactStatistics found = tbb::task_arena(threads).execute([&] {
                return shadows.resolve({casters, scene.originCell, planes, side});
            });
            std::size_t wrong = 0;
            for (std::size_t i = 0; i < plain.size(); ++i)
                wrong += shadows.statuses()[i] != plain[i] ? 1U : 0U;
            EXPECT_EQ(shadows.statuses().size(), plain.size());
            EXPECT_EQ(wrong, 0U) << "of " << plain.size();
            EXPECT_EQ(found.samples, plain.size());
            EXPECT_EQ(found.dark, countOf(plain, kDark | kDarkByEdge));
            EXPECT_EQ(found.darkWithoutTolerance, countOf(plain, kDark | kDarkByEdge | kWithinTolerance));
            EXPECT_EQ(found.withinTolerance, withinToleranceOf(plain));
            if (threads == 1) decisions = found.counts.exactDecisions;
            EXPECT_EQ(found.counts.exactDecisions, decisions);
            if (last.counts.clustersTested > 0) {
                EXPECT_EQ(found.counts.triangles, last.counts.triangles);
                EXPECT_EQ(found.counts.trianglesRasterized, last.counts.trianglesRasterized);
                EXPECT_EQ(found.counts.sampleTests, last.counts.sampleTests);
            }
            last = found;
        }
    });
    return last;
}

std::vector<Corners> someTriangles(RandomWholes& random, int count, std::int64_t max) {
    std::vector<Corners> triangles;
    while (static_cast<int>(triangles.size()) < count) {
        Corners corners{random.point(0, max), random.point(0, max), random.point(0, max)};
        const std::int64_t kind = random.whole(0, 5);
        if (kind == 0) corners[2] = corners[1] + glm::i64vec3(0, 0, 1);
        if (kind == 1 && !triangles.empty()) {
            corners[0] = triangles.back()[1];
            corners[1] = triangles.back()[0];
        }
        if (kind == 2 && !triangles.empty()) corners = triangles.back();
        triangles.push_back(corners);
    }
    return triangles;
}

} // namespace gnomon::exact
