#include "inspect/figures.h"

#include "core/check.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::inspect {

namespace {

__extension__ using Wide = __int128;
using WideVector = std::array<Wide, 3>;

constexpr double kDegrees = 57.29577951308232;

WideVector difference(const glm::i64vec3& to, const glm::i64vec3& from) {
    WideVector result{};
    for (int axis = 0; axis < 3; ++axis) {
        const Wide steps = Wide{to[axis]} - Wide{from[axis]};
        GNOMON_CHECK(steps <= kMaxSteps && steps >= -kMaxSteps);
        result[static_cast<std::size_t>(axis)] = steps;
    }
    return result;
}

WideVector cross(const WideVector& a, const WideVector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Wide dot(const WideVector& a, const WideVector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// Returns the length of an integer vector. If its square fits a double, the root is rounded only once.
double length(const WideVector& steps) {
    const Wide square = dot(steps, steps);
    if (square < Wide{1} << 53U) return std::sqrt(static_cast<double>(square));
    return static_cast<double>(std::sqrt(static_cast<long double>(square)));
}

glm::dvec3 rounded(const WideVector& v) {
    return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

/// Returns the angle in degrees between the two legs at a measured point. It is 180 if the legs form a straight line.
/// Returns nullopt if a leg has no length.
std::optional<double> angleBetween(const WideVector& back, const WideVector& on) {
    if (dot(back, back) == 0 || dot(on, on) == 0) return std::nullopt;
    return kDegrees * std::atan2(glm::length(rounded(cross(back, on))), static_cast<double>(dot(back, on)));
}

/// Returns how far the points `cells` are from a common plane: the max distance, in grid steps, from the plane through
/// their mean that is perpendicular to `normal`.
double offPlane(std::span<const glm::i64vec3> cells, const glm::dvec3& normal) {
    if (!(glm::length(normal) > 0)) return 0;
    const glm::dvec3 unit = glm::normalize(normal);
    double mean = 0;
    for (const glm::i64vec3& cell : cells)
        mean += glm::dot(unit, rounded(difference(cell, cells.front()))) / static_cast<double>(cells.size());
    double maxDistance = 0;
    for (const glm::i64vec3& cell : cells)
        maxDistance = std::max(maxDistance, std::abs(glm::dot(unit, rounded(difference(cell, cells.front()))) - mean));
    return maxDistance;
}

void measurePolygon(std::span<const glm::i64vec3> cells, double step, const glm::dvec3& up, Figures& figures) {
    WideVector twice{};
    for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
        const WideVector part = cross(difference(cells[i], cells[0]), difference(cells[i + 1], cells[0]));
        for (std::size_t axis = 0; axis < 3; ++axis)
            twice[axis] += part[axis];
    }
    const glm::dvec3 vector = rounded(twice);
    figures.perimeter = figures.along + figures.straight;
    figures.area = glm::length(vector) / 2 * step * step;
    figures.planArea = std::abs(glm::dot(vector, up)) / 2 * step * step;
    figures.offPlane = offPlane(cells, vector) * step;
}

} // namespace

Figures figuresOf(std::span<const glm::i64vec3> cells, double step, const glm::dvec3& up) {
    Figures figures;
    if (cells.size() < 2) return figures;
    const glm::dvec3 axis = glm::normalize(up);
    for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
        figures.legs.push_back(length(difference(cells[i + 1], cells[i])) * step);
        figures.along += figures.legs.back();
        if (i > 0)
            figures.anglesDegrees.push_back(
                angleBetween(difference(cells[i - 1], cells[i]), difference(cells[i + 1], cells[i])));
    }
    const WideVector whole = difference(cells.back(), cells.front());
    const glm::dvec3 steps = rounded(whole);
    const double height = glm::dot(axis, steps);
    const double level = glm::length(glm::cross(axis, steps));
    figures.straight = length(whole) * step;
    figures.height = height * step;
    figures.level = level * step;
    figures.slopeDegrees = kDegrees * std::atan2(height, level);
    if (cells.size() > 2) measurePolygon(cells, step, axis, figures);
    return figures;
}

} // namespace gnomon::inspect
