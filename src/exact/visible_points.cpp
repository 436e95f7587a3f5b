#include "exact/visible_points.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace gnomon::exact {

void VisiblePoints::reset(std::size_t maxPoints) {
    constexpr std::size_t kPadding = 16; // the code that reads a batch may read this many elements beyond its end
    size_.store(0, std::memory_order_relaxed);
    for (auto* vectors : {&corner_, &edge1_, &edge2_})
        for (auto& values : *vectors)
            values.ensureCapacity(maxPoints + kPadding);
    for (auto* values : {&second_, &third_})
        values->ensureCapacity(maxPoints + kPadding);
    for (auto* values : {&pixel_, &triangle_})
        values->ensureCapacity(maxPoints + kPadding);
}

void VisiblePoints::add(const PointBatch& batch) {
    const std::size_t first = size_.fetch_add(batch.count, std::memory_order_relaxed);
    const auto keep = [&](auto& to, const auto* from) { std::copy_n(from, batch.count, &to[first]); };
    for (std::size_t axis = 0; axis < 3; ++axis) {
        keep(corner_[axis], batch.corner[axis]);
        keep(edge1_[axis], batch.edge1[axis]);
        keep(edge2_[axis], batch.edge2[axis]);
    }
    keep(second_, batch.second);
    keep(third_, batch.third);
    keep(pixel_, batch.pixel);
    keep(triangle_, batch.triangle);
}

glm::dvec3 VisiblePoints::position(std::size_t i) const {
    glm::dvec3 result;
    for (std::size_t axis = 0; axis < 3; ++axis)
        result[static_cast<int>(axis)] =
            corner_[axis][i] + double{second_[i]} * edge1_[axis][i] + double{third_[i]} * edge2_[axis][i];
    return result;
}

void VisiblePoints::addTo(SampleList& samples, std::uint32_t tolerance) const {
    constexpr std::size_t kBatch = ShearedPoints::kMaxPoints;
    const std::size_t count = size();
    std::array<std::uint32_t, kBatch> tolerances{};
    tolerances.fill(tolerance);
    const std::array<std::int32_t, kBatch> maps{};
    tbb::parallel_for(std::size_t{0}, (count + kBatch - 1) / kBatch, [&](std::size_t b) {
        const std::size_t first = b * kBatch;
        PointBatch batch;
        batch.count = std::min(kBatch, count - first);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            batch.corner[axis] = &corner_[axis][first];
            batch.edge1[axis] = &edge1_[axis][first];
            batch.edge2[axis] = &edge2_[axis][first];
        }
        batch.second = &second_[first];
        batch.third = &third_[first];
        batch.pixel = &pixel_[first];
        batch.triangle = &triangle_[first];
        batch.tolerance = tolerances.data();
        batch.map = maps.data();
        samples.add(batch);
    });
}

} // namespace gnomon::exact
