#include "exact/sample_list.h"

#include "exact/float_rounding.h"

#include <algorithm>
#include <cmath>

namespace gnomon::exact {

namespace {

Corners cornersOf(const PointBatch& batch, std::size_t i) {
    Corners corners;
    for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        corners[0][k] = batch.corner[axis][i];
        corners[1][k] = corners[0][k] + batch.edge1[axis][i];
        corners[2][k] = corners[0][k] + batch.edge2[axis][i];
    }
    return corners;
}

} // namespace

double coordinateErrorFor(double reach) {
    return reach * 0x1p-49;
}

IntegerWeights roundedWeights(float second, float third) {
    constexpr std::int64_t kOne = std::int64_t{1} << kWeightBits;
    const auto rounded = [](float weight) { return static_cast<std::int64_t>(std::lrint(weight * double{kOne})); };
    const std::int64_t b = std::clamp(rounded(second), std::int64_t{1}, kOne - 2);
    const std::int64_t c = std::clamp(rounded(third), std::int64_t{1}, kOne - 1 - b);
    return {static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
}

void SampleList::reset(const SampleSpace& space, std::size_t most) {
    space_ = space;
    const double scale = std::ldexp(1.0, kWeightBits);
    for (int axis = 0; axis < 3; ++axis)
        scaledEye_[axis] = std::llround(space.eye[axis] * scale);
    space_.eye = glm::dvec3(scaledEye_) / scale;
    size_.store(0, std::memory_order_relaxed);
    if (u.size() >= most) return;
    for (auto* values : {&u, &v, &h})
        values->resize(most);
    tolerance.resize(most);
    map.resize(most);
    for (auto* values : {&pixel, &triangle, &second, &third, &integerTolerance})
        values->resize(most);
}

void SampleList::add(const PointBatch& batch) {
    ShearedPoints points;
    shearPoints(space_, batch, points);
    std::size_t facingCount = 0;
    for (std::size_t i = 0; i < batch.count; ++i) {
        if (points.faces[i] == 2) {
            const Corners corners = cornersOf(batch, i);
            points.faces[i] = facing(corners, space_.light) * seenSide(corners, scaledEye_) > 0 ? 1 : 0;
        }
        facingCount += points.faces[i];
    }
    const double perTolerance = std::ldexp(space_.shear.component, -kWeightBits);
    std::size_t to = size_.fetch_add(facingCount, std::memory_order_relaxed);
    for (std::size_t i = 0; i < batch.count; ++i) {
        if (points.faces[i] == 0) continue;
        u[to] = points.u[i];
        v[to] = points.v[i];
        h[to] = points.h[i];
        tolerance[to] = roundedUp(batch.tolerance[i] * perTolerance);
        map[to] = std::clamp(batch.map[i], 0, space_.maps - 1);
        pixel[to] = batch.pixel[i];
        triangle[to] = batch.triangle[i];
        second[to] = points.second[i];
        third[to] = points.third[i];
        integerTolerance[to] = batch.tolerance[i];
        ++to;
    }
}

} // namespace gnomon::exact
