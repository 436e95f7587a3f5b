#include "exact/sample_list.h"

#include "exact/point_predicate.h"

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

SampleSpace pointSpace(const glm::i64vec3& light, const glm::dvec3& eye) {
    SampleSpace space;
    space.shear = {2, 0, 1, 0, 0, 1, 1};
    space.eye = eye;
    space.maps = kPointMaps;
    space.pointLight = light;
    return space;
}

int pointMap(const glm::dvec3& fromLight) {
    int axis = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(fromLight[i]) > std::abs(fromLight[axis])) axis = i;
    const int face = 2 * axis + (fromLight[axis] < 0 ? 1 : 0);
    return std::abs(fromLight[axis]) < kNearPointLight ? kPointMaps / 2 + face : face;
}

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

void SampleList::reset(const SampleSpace& space, std::size_t maxPoints) {
    space_ = space;
    const double scale = std::ldexp(1.0, kWeightBits);
    for (int axis = 0; axis < 3; ++axis)
        scaledEye_[axis] = std::llround(space.eye[axis] * scale);
    space_.eye = glm::dvec3(scaledEye_) / scale;
    perTolerance_ = space.shear.component / scale;
    size_.store(0, std::memory_order_relaxed);
    constexpr std::size_t kPadding = 16;
    for (auto* values : {&u, &v, &h})
        values->ensureCapacity(maxPoints + kPadding);
    for (auto* values : {&pixel, &triangle, &second, &third, &tolerance})
        values->ensureCapacity(maxPoints);
    if (space.maps > 1) map.ensureCapacity(maxPoints + kPadding);
}

void SampleList::add(const PointBatch& batch) {
    ShearedPoints points;
    shearPoints(space_, batch, points);
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): the loop writes each read element
    std::array<std::uint8_t, ShearedPoints::kMaxPoints> chosen;
    std::size_t count = 0;
    for (std::size_t i = 0; i < batch.count; ++i) {
        if (points.faces[i] == 2) {
            const Corners corners = cornersOf(batch, i);
            const int side =
                space_.pointLight ? facingPoint(corners, *space_.pointLight) : facing(corners, space_.light);
            points.faces[i] = side * visibleSide(corners, scaledEye_) > 0 ? 1 : 0;
        }
        chosen[count] = static_cast<std::uint8_t>(i);
        count += points.faces[i];
    }
    const std::size_t first = size_.fetch_add(count, std::memory_order_relaxed);
    const auto keep = [&](auto& to, const auto* from) {
        if (count == batch.count)
            std::copy_n(from, count, &to[first]);
        else
            for (std::size_t i = 0; i < count; ++i)
                to[first + i] = from[chosen[i]];
    };
    if (count == 0) return;
    keep(u, points.u.data());
    keep(v, points.v.data());
    keep(h, points.h.data());
    keep(second, points.second.data());
    keep(third, points.third.data());
    keep(pixel, batch.pixel);
    keep(triangle, batch.triangle);
    keep(tolerance, batch.tolerance);
    if (space_.maps == 1) return;
    if (space_.pointLight) {
        const glm::dvec3 light(*space_.pointLight);
        for (std::size_t i = first; i < first + count; ++i)
            map[i] = pointMap(glm::dvec3(u[i], v[i], h[i]) - light);
        return;
    }
    for (std::size_t i = 0; i < count; ++i)
        map[first + i] = std::clamp(batch.map[chosen[i]], 0, space_.maps - 1);
}

} // namespace gnomon::exact
