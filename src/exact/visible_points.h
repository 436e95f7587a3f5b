// The visible points of one image, kept so that light after light can be asked which of them it reaches.
#pragma once

#include "exact/sample_list.h"

namespace gnomon::exact {

/// Points as an image pass finds them, whether they face a light or not. Their order means nothing: each has its pixel.
class VisiblePoints {
public:
    /// Empties the list and makes room for `most` points.
    void reset(std::size_t most);

    /// Adds all points of a batch, without their maps, tolerances and colours. From any thread.
    void add(const PointBatch& batch);

    std::size_t size() const { return size_.load(std::memory_order_relaxed); }

    /// The pixel of point `i`.
    std::uint32_t pixel(std::size_t i) const { return pixel_[i]; }

    /// Where point `i` lies, cells from the frame's origin, as its weights in floats have it.
    glm::dvec3 position(std::size_t i) const;

    /// Adds to `samples`, which was reset for a light and has room for all points, those that face the light, with
    /// `tolerance` as `meet` takes it. On all cores of the caller's TBB arena.
    void addTo(SampleList& samples, std::uint32_t tolerance) const;

    /// What the arrays take of memory a point.
    static constexpr std::uint64_t kBytesPerPoint = 13 * sizeof(std::uint32_t);

private:
    std::array<FrameArray<std::int32_t>, 3> corner_, edge1_, edge2_;
    FrameArray<float> second_, third_;
    FrameArray<std::uint32_t> pixel_, triangle_;
    std::atomic<std::size_t> size_{0};
};

} // namespace gnomon::exact
