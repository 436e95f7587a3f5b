// Small scenes for exact shadows, and the plain loop over all samples and triangles that says what is true of them.
#pragma once

#include "exact/exact_shadows.h"
#include "tests/exact/random.h"

#include <vector>

namespace gnomon::exact {

/// Triangles of all shapes on whole cells from 0 to `most`: copies in one place, slivers, ones that share edges.
std::vector<Corners> someTriangles(RandomWholes& random, int count, std::int64_t most);

/// A visible point: a place on a triangle.
struct ScenePoint {
    std::uint32_t triangle = 0; // as samples name it
    float second = 0.25F;
    float third = 0.25F;
    std::int32_t map = 0;
    std::uint32_t tolerance = 0;
};

/// Clusters of triangles, and points on them.
class Scene {
public:
    /// Adds one cluster of at most 85 triangles; their corners count from the frame's origin. Answers the name of its
    /// first.
    std::uint32_t add(const std::vector<Corners>& triangles);

    /// Adds one cluster of vertices that triangles share.
    std::uint32_t add(const std::vector<glm::i64vec3>& vertices, const std::vector<raster::Triangle>& triangles);

    Corners corners(std::uint32_t triangle) const;

    /// Of all triangles, in their order.
    const std::vector<std::uint32_t>& names() const { return names_; }

    /// They borrow the scene's arrays.
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

/// Gives `samples` the points, some batches of them.
void fill(SampleList& samples, const Scene& scene, const SampleSpace& space);

/// The points, several at a time, as an image pass gives them.
class SceneBatch {
public:
    SceneBatch(const Scene& scene, std::size_t begin, std::size_t end);

    const PointBatch& batch() const { return batch_; }

private:
    std::array<std::array<std::int32_t, ShearedPoints::kMost>, 9> edges_{};
    std::array<float, ShearedPoints::kMost> second_{}, third_{};
    std::array<std::int32_t, ShearedPoints::kMost> map_{};
    std::array<std::uint32_t, ShearedPoints::kMost> pixel_{}, triangle_{}, tolerance_{}, color_{};
    PointBatch batch_;
};

/// A space with its shear; the eye in cells from the origin.
SampleSpace spaceOf(const IntegerLight& light, const glm::dvec3& eye, int maps = 1);

/// The status of each sample, by `meet` with every triangle of the scene.
std::vector<std::uint8_t> plainStatuses(const SampleList& samples, const Scene& scene);

/// Holds what `decide` finds against the plain loop, on every instruction set, with one thread and with two. Answers
/// the last statistics.
ExactStatistics expectSameAsPlain(
    const Scene& scene, const SampleSpace& space, const std::vector<glm::dmat3>& planes, int side);

} // namespace gnomon::exact
