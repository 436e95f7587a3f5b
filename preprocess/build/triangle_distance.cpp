#include "preprocess/build/triangle_distance.h"

#include <algorithm>

namespace gnomon::preprocess {

namespace {

/// The nearest point of the segment from corner `i` to the next.
Footing edgeFooting(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners, std::uint32_t i) {
    const glm::dvec3& a = corners[i];
    const glm::dvec3 edge = corners[(i + 1) % 3] - a;
    const glm::dvec3 offset = p - a;
    const double length = glm::dot(edge, edge);
    const double along = glm::dot(offset, edge);
    if (along <= 0) return {glm::dot(offset, offset), static_cast<Nearest>(4 + i)};
    if (along >= length) {
        const glm::dvec3 rest = offset - edge;
        return {glm::dot(rest, rest), static_cast<Nearest>(4 + (i + 1) % 3)};
    }
    const glm::dvec3 rest = offset - edge * (along / length);
    return {glm::dot(rest, rest), static_cast<Nearest>(1 + i)};
}

} // namespace

Footing footing(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const std::array<glm::dvec3, 3> corners{a, b, c};
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area = glm::dot(normal, normal);
    bool isInside = area > 0;
    for (std::uint32_t i = 0; i < 3 && isInside; ++i)
        isInside = glm::dot(glm::cross(normal, corners[(i + 1) % 3] - corners[i]), p - corners[i]) >= 0;
    if (isInside) {
        const double height = glm::dot(normal, p - a);
        return {height * height / area, Nearest::Face};
    }
    Footing best = edgeFooting(p, corners, 0);
    for (std::uint32_t i = 1; i < 3; ++i) {
        const Footing other = edgeFooting(p, corners, i);
        if (other.square < best.square) best = other;
    }
    return best;
}

} // namespace gnomon::preprocess
