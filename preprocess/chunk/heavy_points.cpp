#include "preprocess/chunk/heavy_points.h"

#include "core/random.h"

#include <algorithm>

namespace gnomon::chunk {

namespace {

constexpr std::size_t kRemembered = std::size_t{1} << 16U;

/// Returns the counter in DroppedTriangles for a triangle between heavy points that repeats an earlier triangle.
/// Returns null if the reason of the drop depends on positions that are not stored.
std::uint64_t DroppedTriangles::*reasonOf(
    const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found) {
    bool isCollapsed = false;
    bool isUnknown = false;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t k = (i + 1) % 3;
        if (found[i] / 2 != found[k] / 2) continue;
        const bool isFirst = found[i] % 2 == 0 && found[k] % 2 == 0;
        if (isFirst || corners[i] == corners[k]) return &DroppedTriangles::degenerate;
        isCollapsed = true;
        // Two corners that both differ from the first position at a heavy point may have equal or different positions.
        isUnknown = isUnknown || found[i] == found[k];
    }
    if (isUnknown) return nullptr;
    return isCollapsed ? &DroppedTriangles::collapsedByGrid : &DroppedTriangles::doubled;
}

} // namespace

HeavyPoints::HeavyPoints(std::vector<hierarchy::GridPoint> points, std::size_t maxPoints) : points_(std::move(points)) {
    points_.resize(std::min(points_.size(), maxPoints));
    std::sort(points_.begin(), points_.end());
    first_.resize(points_.size());
    if (!points_.empty()) earlier_.resize(kRemembered);
}

std::optional<std::uint32_t> HeavyPoints::find(const hierarchy::GridPoint& point, const glm::dvec3& position) {
    const auto place = std::lower_bound(points_.begin(), points_.end(), point);
    if (place == points_.end() || *place != point) return std::nullopt;
    const auto which = static_cast<std::size_t>(place - points_.begin());
    if (!first_[which]) first_[which] = position;
    return static_cast<std::uint32_t>(2 * which + (*first_[which] == position ? 0 : 1));
}

bool HeavyPoints::isRepeated(
    const read::TriangleCorners& corners, const std::array<std::uint32_t, 3>& found, DroppedTriangles& dropped) {
    std::uint64_t DroppedTriangles::*const reason = reasonOf(corners, found);
    if (reason == nullptr) return false;
    std::array<std::uint64_t, 3> points{found[0] / 2, found[1] / 2, found[2] / 2};
    std::sort(points.begin(), points.end());
    // The index of a heavy point is below 2^16, so the key of three indices is unique.
    const std::uint64_t key = 1 + (points[0] << 32U | points[1] << 16U | points[2]);
    std::uint64_t& earlier = earlier_[mix64(key) % kRemembered];
    if (earlier != key) {
        earlier = key;
        return false;
    }
    ++(dropped.*reason);
    return true;
}

} // namespace gnomon::chunk
