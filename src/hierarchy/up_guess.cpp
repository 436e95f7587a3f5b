#include "hierarchy/up_guess.h"

#include "hierarchy/cut_rule.h"
#include "hierarchy/grid.h"

#include <algorithm>
#include <cmath>

namespace gnomon::hierarchy {

namespace {

constexpr double kBase = 0.02;     // of the height: what counts as lowest
constexpr double kLevel = 0.985;   // the cosine from which on a triangle is level: 10 degrees
constexpr double kStanding = 0.4;  // of the outline
constexpr double kStandingY = 0.3; // likewise: y needs less to be believed
constexpr double kWithin = 0.3;
constexpr double kLow = 0.45; // of the height
constexpr double kLowY = 0.6;
constexpr double kThick = 0.2; // of the width: what is flatter is a sheet or a slab, which lies or is held
constexpr double kStandingElsewhere = 0.2;
constexpr double kBuilt = 0.15; // of the area along one axis: what is made of floors and walls
constexpr double kMostlyLevel = 0.8;
constexpr double kLand = 0.9;
constexpr double kWideLand = 1000;
constexpr double kFarAway = 20; // widths
constexpr double kFloors = 0.3;
constexpr double kFloorsOfWalls = 1.4;
constexpr double kWallsAlike = 2;
constexpr double kFlat = 0.12; // of the width: the least height of what has floors

/// Directions around a circle, in whole numbers so that no sine is needed.
glm::dvec2 bearing(int index) {
    constexpr std::array<std::array<int, 2>, 8> kQuarter = {
        {{4, 0}, {4, 1}, {4, 2}, {4, 3}, {4, 4}, {3, 4}, {2, 4}, {1, 4}}};
    const auto& [x, y] = kQuarter.at(static_cast<std::size_t>(index % 8));
    switch (index / 8) {
    case 0:
        return {x, y};
    case 1:
        return {-y, x};
    case 2:
        return {-x, -y};
    default:
        return {y, -x};
    }
}

/// `position` without its coordinate along `axis`.
glm::dvec2 across(const glm::dvec3& position, int axis) {
    return {position[(axis + 1) % 3], position[(axis + 2) % 3]};
}

std::string percent(double share) {
    return std::to_string(std::lround(100 * share)) + "%";
}

UpAxis axisOf(int axis, bool isDown) {
    UpAxis up;
    up.direction = glm::dvec3(0);
    up.direction[axis] = isDown ? -1 : 1;
    return up;
}

} // namespace

void UpSurvey::Outline::add(const glm::dvec2& point) {
    if (isEmpty) corners.fill(point);
    isEmpty = false;
    for (int i = 0; i < kBearings; ++i) {
        glm::dvec2& corner = corners[static_cast<std::size_t>(i)];
        if (glm::dot(point - corner, bearing(i)) > 0) corner = point;
    }
}

double UpSurvey::Outline::area() const {
    double twice = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 a = corners[i] - corners[0];
        const glm::dvec2 b = corners[(i + 1) % corners.size()] - corners[0];
        twice += a.x * b.y - a.y * b.x;
    }
    return twice / 2;
}

double UpSurvey::Outline::depthOf(const glm::dvec2& point) const {
    double depth = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 side = corners[(i + 1) % corners.size()] - corners[i];
        const double length = glm::length(side);
        if (!(length > 0)) continue;
        const glm::dvec2 to = point - corners[i];
        depth = std::min(depth, (side.x * to.y - side.y * to.x) / length);
    }
    return std::isfinite(depth) ? depth : 0;
}

UpSurvey::UpSurvey(const Grid& grid, const Box& bounds)
    : extent_(bounds.extent()),
      least_(bounds.min - grid.origin),
      step_(grid.step()),
      distance_(bounds.isEmpty() ? 0 : glm::length(bounds.center())) {}

void UpSurvey::addVertex(const glm::dvec3& position) {
    for (int axis = 0; axis < 3; ++axis) {
        Axis& seen = axes_[static_cast<std::size_t>(axis)];
        const glm::dvec2 point = across(position, axis);
        seen.whole.add(point);
        const double height = position[axis] - least_[axis];
        if (height <= kBase * extent_[axis]) seen.base[0].add(point);
        if (height >= (1 - kBase) * extent_[axis]) seen.base[1].add(point);
    }
}

void UpSurvey::add(const Page& page, double error) {
    const auto isRefined = [error](double groupError, const Sphere&) { return groupError > error; };
    const auto positionOf = [&](const Cluster& cluster, std::size_t vertex) {
        const GridPoint& p = page.vertices[cluster.firstVertex + vertex].position;
        return glm::dvec3(p.x, p.y, p.z) * step_;
    };
    forEachDrawn(page, isRefined, [&](const Group&, const Cluster& cluster) {
        for (std::uint32_t v = 0; v < cluster.vertexCount; ++v)
            addVertex(positionOf(cluster, v));
        for (std::uint32_t t = cluster.firstTriangle; t < cluster.firstTriangle + cluster.triangleCount; ++t) {
            const Triangle& triangle = page.triangles[t];
            const glm::dvec3 a = positionOf(cluster, triangle[0]);
            const glm::dvec3 b = positionOf(cluster, triangle[1]);
            const glm::dvec3 c = positionOf(cluster, triangle[2]);
            const glm::dvec3 twice = glm::cross(b - a, c - a);
            const double area = 0.5 * glm::length(twice);
            area_ += area;
            moment_ += area * (a + b + c) / 3.0;
            facing_ += 0.5 * twice;
            for (int axis = 0; axis < 3; ++axis)
                if (std::abs(0.5 * twice[axis]) > kLevel * area)
                    axes_[static_cast<std::size_t>(axis)].levelArea += area;
        }
    });
}

UpSurvey::Footing UpSurvey::footing(int axis, bool isDown) const {
    const Axis& seen = axes_[static_cast<std::size_t>(axis)];
    const Outline& base = seen.base[isDown ? 1 : 0];
    const double whole = seen.whole.area();
    if (!(whole > 0) || base.isEmpty || !(area_ > 0) || !(extent_[axis] > 0)) return {};
    const glm::dvec3 middle = moment_ / area_;
    const double deepest = seen.whole.depthOf(across(middle, axis));
    const double height = (middle[axis] - least_[axis]) / extent_[axis];
    return {
        base.area() / whole,
        deepest > 0 ? base.depthOf(across(middle, axis)) / deepest : 0,
        isDown ? 1 - height : height};
}

bool UpSurvey::stands(int axis, bool isDown) const {
    const bool isY = axis == 1 && !isDown;
    const double width = std::max(extent_[(axis + 1) % 3], extent_[(axis + 2) % 3]);
    if (!isY && extent_[axis] < kThick * width) return false;
    const double mostLevel = std::max({share(0), share(1), share(2)});
    if (!isY && mostLevel > kBuilt && share(axis) < kMostlyLevel * mostLevel) return false; // a wall, not a floor
    const Footing found = footing(axis, isDown);
    return found.share >= (isY ? kStandingY : kStanding) && found.within >= kWithin &&
           found.height <= (isY ? kLowY : kLow);
}

bool UpSurvey::isLand() const {
    const double width = std::max(extent_.x, extent_.y);
    return area_ > 0 && std::abs(facing_.z) >= kLand * area_ && extent_.z < kThick * width &&
           (width > kWideLand || distance_ > kFarAway * width);
}

bool UpSurvey::hasFloors() const {
    const double width = std::max(extent_.x, extent_.y);
    const double walls = std::max(share(0), share(1));
    return share(2) >= kFloors && share(2) >= kFloorsOfWalls * walls &&
           walls <= kWallsAlike * std::min(share(0), share(1)) && extent_.z >= kFlat * width &&
           extent_.z < std::min(extent_.x, extent_.y);
}

UpGuess UpSurvey::guess() const {
    if (isLand())
        return {axisOf(2, false), percent(std::abs(facing_.z) / area_) + " of it faces z, as land does", true};
    if (stands(1, false))
        return {UpAxis(), "it stands on " + percent(footing(1, false).share) + " of its outline", true};
    std::optional<UpGuess> found;
    double second = 0;
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const bool isDown = side % 2 == 1;
        const Footing here = footing(axis, isDown);
        if (!found && stands(axis, isDown))
            found = {axisOf(axis, isDown), "it stands on " + percent(here.share) + " of its outline", true};
        else if (here.within > 0)
            second = std::max(second, here.share);
    }
    if (found && second < kStandingElsewhere) return *found;
    if (hasFloors()) return {axisOf(2, false), percent(share(2)) + " of its area is level, as floors are", true};
    return {UpAxis(), "nothing speaks clearly for another axis", false};
}

} // namespace gnomon::hierarchy
