// The visible points that face the light, one for each such pixel: what exact shadows have to decide.
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

/// Visible points as an image pass finds them, value by value; each array can be read up to the next multiple of 16.
struct PointBatch {
    std::size_t count = 0;
    std::array<const std::int32_t*, 3> corner{}; // corner 0, grid cells from the frame's origin
    std::array<const std::int32_t*, 3> edge1{};  // from there to corner 1, cells
    std::array<const std::int32_t*, 3> edge2{};  // to corner 2
    const float* second = nullptr;               // weights of corners 1 and 2, from 0 to 1
    const float* third = nullptr;
    const std::int32_t* map = nullptr;        // whose cells hold the point; outside [0, maps) the nearest
    const std::uint32_t* pixel = nullptr;     // its name to the caller
    const std::uint32_t* triangle = nullptr;  // its name among the casters: place of the cluster << 8 | triangle
    const std::uint32_t* tolerance = nullptr; // as `meet` takes it
    const std::uint32_t* color = nullptr;     // what the caller wants to find beside it; null: nothing
};

/// What all points of a frame share.
struct SampleSpace {
    IntegerLight light;
    LightShear shear;
    glm::dvec3 eye{0}; // cells from the frame's origin; a list rounds it to 2^-24 cells
    int maps = 1;
    std::optional<glm::i64vec3> pointLight; // takes the place of `light`: a grid point, cells from the frame's origin;
                                            // each coordinate is below 2^52 in size
};

/// The maps of a point light: one a face of the cube about it, and one more of each for what lies near it, which else
/// would have the others' cells large.
constexpr int kPointMaps = 12;

/// The space of a point light: no shear, so that u, v and h are x, y and z.
SampleSpace pointSpace(const glm::i64vec3& light, const glm::dvec3& eye);

/// The map of a point light that holds what lies so many cells from it.
int pointMap(const glm::dvec3& fromLight);

/// Between the maps of what is near and the others: cells along the axis of the face.
constexpr double kNearPointLight = 32;

/// An upper bound of how far u, v and h of a sample or a corner may be off, for triangles within `reach` cells of the
/// origin on each axis: 16 roundings of a number of that size, of which a sample's u takes 14 (5 each for the point's
/// two coordinates, 1 for the ratio, 1 for its product, 2 for the difference).
double coordinateErrorFor(double reach);

/// Weights of corners 1 and 2 in 2^-24, such that the point is strictly within its triangle; at most 2^-23 off.
struct IntegerWeights {
    std::uint32_t second = 1;
    std::uint32_t third = 1;
};

IntegerWeights roundedWeights(float second, float third);

/// The samples of one frame, array by array; keeps its memory from frame to frame. Of the room for all it touches only
/// what samples take.
class SampleList {
public:
    /// Empties the list and makes room for `most` samples.
    void reset(const SampleSpace& space, std::size_t most);

    /// Adds the points that face the light: those of which eye and light are on the same side of the triangle, by exact
    /// signs. From any thread; the order of samples means nothing. At most as many as `reset` made room for.
    void add(const PointBatch& batch);

    /// Makes `count` samples more and answers the first's place; the caller fills their u, v, h, pixel, triangle,
    /// second, third and tolerance. Within the room that `reset` made, of a space of one map.
    std::size_t append(std::size_t count) { return size_.fetch_add(count, std::memory_order_relaxed); }

    std::size_t size() const { return size_.load(std::memory_order_relaxed); }

    /// The most samples that there is room for.
    std::size_t room() const { return pixel.size(); }

    const SampleSpace& space() const { return space_; }

    /// The map of sample `i`.
    std::size_t mapOf(std::size_t i) const { return space_.maps == 1 ? 0 : static_cast<std::size_t>(map[i]); }

    /// Cells along h for one of a tolerance as `meet` takes it.
    double perTolerance() const { return perTolerance_; }

    /// What the arrays take of memory a sample.
    static constexpr std::uint64_t kBytesPerSample = 3 * sizeof(double) + 6 * sizeof(std::uint32_t);

    // Of each sample: where it lies in the shear of the light (cells), padded; a grid puts these in its own order.
    FrameArray<double> u, v, h;
    // Its pixel and triangle, the point's weights, its tolerance, and what the caller gave beside it.
    FrameArray<std::uint32_t> pixel, triangle, second, third, tolerance, color;
    FrameArray<std::int32_t> map; // where there is more than one; padded

private:
    SampleSpace space_;
    glm::i64vec3 scaledEye_{0};
    double perTolerance_ = 0;
    std::atomic<std::size_t> size_{0};
};

/// A batch's points in the shear of the light, and whether each faces it: 1 yes, 0 no, 2 where doubles do not tell.
struct ShearedPoints {
    static constexpr std::size_t kMost = 128;
    std::array<double, kMost> u{}, v{}, h{};
    std::array<std::uint32_t, kMost> second{}, third{};
    std::array<std::uint8_t, kMost> faces{};
};

/// Fills `points` for the batch of at most ShearedPoints::kMost; the result does not depend on the instruction set.
void shearPoints(const SampleSpace& space, const PointBatch& batch, ShearedPoints& points);

} // namespace gnomon::exact
