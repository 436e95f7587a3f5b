// Small scenes for exact shadows, and a simple loop over all samples and triangles as ground truth.
#pragma once

#include "exact/exact_shadows.h"
#include "tests/exact/random.h"

#include <vector>

namespace gnomon::exact {

/// Returns triangles of many shapes on integer cells from 0 to `max`, including duplicates, slivers and triangles with
/// shared edges.
std::vector<Corners> someTriangles(RandomWholes& random, int count, std::int64_t max);

/// A visible point on a triangle.
struct ScenePoint {
    std::uint32_t triangle = 0; // id of the triangle, as in samples
    float second = 0.25F;
    float third = 0.25F;
    std::int32_t map = 0;
    std::uint32_t tolerance = 0;
};

/// Clusters of triangles, with points on them.
class Scene {
public:
    /// Adds a cluster of at most 85 triangles. Corners are relative to the frame's origin. Returns the id of its first
    /// triangle.
    std::uint32_t add(const std::vector<Corners>& triangles);

    /// Adds a cluster with shared vertices.
    std::uint32_t add(const std::vector<glm::i64vec3>& vertices, const std::vector<raster::Triangle>& triangles);

    Corners corners(std::uint32_t triangle) const;

    /// Returns the ids of all triangles, in order.
    const std::vector<std::uint32_t>& names() const { return names_; }

    /// Returns casters that refer to the scene's arrays.
    std::vector<Caster> casters() const;

    std::vector<ScenePoint> points;
    glm::uvec3 originCell{0x80000000U, 0x7FFFFFF0U, 12};

private:
    struct Cluster {
        std::vector<glm::i64vec3> vertices;
        std::vector<glm::uvec3> positions;
        std::vector<raster::Triangle> triangles;
    };

    std::vector<Cluster> clusters_;
    std::vector<std::uint32_t> names_;
};

/// Adds the points of `scene` to `samples` in several batches.
void fill(SampleList& samples, const Scene& scene, const SampleSpace& space);

/// A batch of points in the format of an image pass.
class SceneBatch {
public:
    SceneBatch(const Scene& scene, std::size_t begin, std::size_t end);

    const PointBatch& batch() const { return batch_; }

private:
    std::array<std::array<std::int32_t, ShearedPoints::kMaxPoints>, 9> edges_{};
    std::array<float, ShearedPoints::kMaxPoints> second_{}, third_{};
    std::array<std::int32_t, ShearedPoints::kMaxPoints> map_{};
    std::array<std::uint32_t, ShearedPoints::kMaxPoints> pixel_{}, triangle_{}, tolerance_{};
    PointBatch batch_;
};

/// Returns a sample space with its shear. `eye` is in cells from the origin.
SampleSpace spaceOf(const IntegerLight& light, const glm::dvec3& eye, int maps = 1);

/// Returns the status of each sample, by `intersect` with each triangle of the scene.
std::vector<std::uint8_t> plainStatuses(const SampleList& samples, const Scene& scene);

/// Compares `resolve` with the simple loop, on all instruction sets, with one thread and with two. Returns the last
/// statistics.
ExactStatistics expectSameAsPlain(
    const Scene& scene, const SampleSpace& space, const std::vector<glm::dmat3>& planes, int side);

} // namespace gnomon::exact
