// The samples of exact shadows: the visible points that face the light, one per pixel.
#pragma once

#include "exact/frame_array.h"
#include "exact/light_shear.h"
#include "exact/predicate.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace gnomon::exact {

/// A batch of visible points of an image, as one array per attribute. Each array is readable up to the next multiple of
/// 16 elements.
struct PointBatch {
    std::size_t count = 0;
    std::array<const std::int32_t*, 3> corner{}; // corner 0, in grid cells from the frame's origin
    std::array<const std::int32_t*, 3> edge1{};  // corner 1 minus corner 0, in cells
    std::array<const std::int32_t*, 3> edge2{};  // corner 2 minus corner 0, in cells
    const float* second = nullptr;               // barycentric weights of corners 1 and 2, in [0, 1]
    const float* third = nullptr;
    // Index of the shadow map for this point. Values outside [0, maps) are clamped.
    const std::int32_t* map = nullptr;
    const std::uint32_t* pixel = nullptr;     // pixel id, chosen by the caller
    const std::uint32_t* triangle = nullptr;  // triangle id among the casters: index of the cluster << 8 | triangle
    const std::uint32_t* tolerance = nullptr; // the argument `tolerance` of `intersect`
};

/// The light, the eye and the coordinate system of all samples of a frame.
struct SampleSpace {
    IntegerLight light;
    LightShear shear;
    glm::dvec3 eye{0}; // cells from the frame's origin; a list rounds it to 2^-24 cells
    int maps = 1;
    /// The position of a point light, if the frame has one instead of a directional light. It is a grid point, in cells
    /// from the frame's origin. Each absolute coordinate is below 2^52.
    std::optional<glm::i64vec3> pointLight;
};

/// Number of grid maps for a point light: two for each face of the cube around the light, one of them for points near
/// the light. With only one map per face, cells would have to be large.
constexpr int kPointMaps = 12;

/// Returns the coordinate system of the samples for a point light. It has no shear: u, v and h are x, y and z.
SampleSpace pointSpace(const glm::i64vec3& light, const glm::dvec3& eye);

/// Returns the index of the grid map that contains a point, for a point light. `fromLight` is the vector from the light
/// to the point, in cells.
int pointMap(const glm::dvec3& fromLight);

/// Max distance from a point light, in cells along the axis of a cube face, at which points belong to the near map of
/// the face.
constexpr double kNearPointLight = 32;

/// Returns an upper bound of the rounding error of u, v and h of a sample or a corner, in cells. All triangles must be
/// within `reach` cells of the origin, per axis. The bound is 16 roundings of a number of that size. The u of a sample
/// has 14 roundings: 5 for each of the point's two coordinates, 1 for the ratio, 1 for its product, and 2 for the
/// difference.
double coordinateErrorFor(double reach);

/// The barycentric weights of a point for corners 1 and 2, in units of 2^-24. The point is strictly inside its
/// triangle. The error of a weight is at most 2^-23.
struct IntegerWeights {
    std::uint32_t second = 1;
    std::uint32_t third = 1;
};

IntegerWeights roundedWeights(float second, float third);

/// The samples of one frame: visible points that face the light, as one array per attribute. The list reuses its memory
/// between frames. It reserves address space for the max number of samples, but uses physical memory only for existing
/// samples.
class SampleList {
public:
    /// Removes all samples and reserves memory for at most `maxPoints` samples.
    void reset(const SampleSpace& space, std::size_t maxPoints);

    /// Adds the points of `batch` that face the light. A point faces the light if eye and light are on the same side of
    /// its triangle, tested with exact predicates. Can run on any thread, so the order of samples is undefined. The
    /// list must not exceed the `maxPoints` of `reset`.
    void add(const PointBatch& batch);

    /// Appends `count` samples and returns the index of the first new sample. The caller then sets their u, v, h,
    /// pixel, triangle, second, third and tolerance. The list must not exceed the `maxPoints` of `reset`, and the space
    /// must have one map.
    std::size_t append(std::size_t count) { return size_.fetch_add(count, std::memory_order_relaxed); }

    std::size_t size() const { return size_.load(std::memory_order_relaxed); }

    /// Returns the max number of samples for which memory is reserved.
    std::size_t room() const { return pixel.size(); }

    const SampleSpace& space() const { return space_; }

    /// Returns the index of the map that contains sample `i`.
    std::size_t mapOf(std::size_t i) const { return space_.maps == 1 ? 0 : static_cast<std::size_t>(map[i]); }

    /// Returns the distance along h, in cells, of one unit of the argument `tolerance` of `intersect`.
    double perTolerance() const { return perTolerance_; }

    /// Memory of the sample arrays per sample, in bytes.
    static constexpr std::uint64_t kBytesPerSample = 3 * sizeof(double) + 5 * sizeof(std::uint32_t);

    // Position of each sample in the sheared light space, in cells. The arrays are padded to whole SIMD vectors. A
    // sample grid sorts them.
    FrameArray<double> u, v, h;
    // Pixel id, triangle id, barycentric weights and tolerance of each sample.
    FrameArray<std::uint32_t> pixel, triangle, second, third, tolerance;
    FrameArray<std::int32_t> map; // only with more than one map; padded

private:
    SampleSpace space_;
    glm::i64vec3 scaledEye_{0};
    double perTolerance_ = 0;
    std::atomic<std::size_t> size_{0};
};

/// The points of a batch in the sheared light space. An entry of `faces` is 1 if the point faces the light and 0 if
/// not. It is 2 if the rounding errors of doubles are too large to tell.
struct ShearedPoints {
    static constexpr std::size_t kMaxPoints = 128;
    std::array<double, kMaxPoints> u{}, v{}, h{};
    std::array<std::uint32_t, kMaxPoints> second{}, third{};
    std::array<std::uint8_t, kMaxPoints> faces{};
};

/// Transforms the points of `batch` to the sheared light space, and stores them in `points`. `batch` has at most
/// ShearedPoints::kMaxPoints points. The result does not depend on the instruction set.
void shearPoints(const SampleSpace& space, const PointBatch& batch, ShearedPoints& points);

} // namespace gnomon::exact
