// The visible points of one image, stored so that the shadows of several lights can be computed one after another.
#pragma once

#include "exact/sample_list.h"

namespace gnomon::exact {

/// A list of all visible points of an image, including points that face away from the light. The order is undefined,
/// and each point stores its pixel.
class VisiblePoints {
public:
    /// Removes all points and reserves memory for `maxPoints` points.
    void reset(std::size_t maxPoints);

    /// Adds all points of `batch`, but not their shadow map indices and tolerances. Can run on any thread.
    void add(const PointBatch& batch);

    std::size_t size() const { return size_.load(std::memory_order_relaxed); }

    /// Returns the pixel id of point `i`.
    std::uint32_t pixel(std::size_t i) const { return pixel_[i]; }

    /// Returns the position of point `i`, in cells from the frame's origin, computed from its float weights.
    glm::dvec3 position(std::size_t i) const;

    /// Adds the points that face the light to `samples`, all with the tolerance `tolerance` (see `intersect`).
    /// `samples` must be reset for the light and have memory for all points. Runs on all cores of the caller's TBB
    /// arena.
    void addTo(SampleList& samples, std::uint32_t tolerance) const;

private:
    std::array<FrameArray<std::int32_t>, 3> corner_, edge1_, edge2_;
    FrameArray<float> second_, third_;
    FrameArray<std::uint32_t> pixel_, triangle_;
    std::atomic<std::size_t> size_{0};
};

} // namespace gnomon::exact
