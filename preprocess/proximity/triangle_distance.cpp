#include "preprocess/proximity/triangle_distance.h"

#include <algorithm>
#include <limits>

namespace gnomon::proximity {

PreparedTriangle::PreparedTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
    : corners_{a, b, c},
      edges_{b - a, c - b, a - c},
      inwards_{
          glm::cross(glm::cross(b - a, c - a), edges_[0]),
          glm::cross(glm::cross(b - a, c - a), edges_[1]),
          glm::cross(glm::cross(b - a, c - a), edges_[2])},
      normal_(glm::cross(b - a, c - a)),
      area_(glm::dot(normal_, normal_)) {}

TriangleDistance PreparedTriangle::distanceToEdge(const glm::dvec3& p, std::uint32_t i) const {
    const glm::dvec3& edge = edges_[i];
    const glm::dvec3 offset = p - corners_[i];
    const double length = glm::dot(edge, edge);
    const double along = glm::dot(offset, edge);
    if (along <= 0) return {glm::dot(offset, offset), static_cast<TriangleFeature>(4 + i)};
    if (along >= length) {
        const glm::dvec3 rest = offset - edge;
        return {glm::dot(rest, rest), static_cast<TriangleFeature>(4 + (i + 1) % 3)};
    }
    const glm::dvec3 rest = offset - edge * (along / length);
    return {glm::dot(rest, rest), static_cast<TriangleFeature>(1 + i)};
}

TriangleDistance PreparedTriangle::distanceTo(const glm::dvec3& p) const {
    // The point `p` is outside the triangle, so its nearest point is on an edge whose outer side contains `p`.
    TriangleDistance best{std::numeric_limits<double>::infinity()};
    bool isInside = area_ > 0;
    for (std::uint32_t i = 0; i < 3; ++i) {
        if (area_ > 0 && glm::dot(inwards_[i], p - corners_[i]) >= 0) continue;
        isInside = false;
        const TriangleDistance other = distanceToEdge(p, i);
        if (other.square < best.square) best = other;
    }
    if (!isInside) return best;
    const double height = glm::dot(normal_, p - corners_[0]);
    return {height * height / area_, TriangleFeature::Face};
}

TriangleDistance distanceToTriangle(
    const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    return PreparedTriangle(a, b, c).distanceTo(p);
}

double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto squareOf = [](const glm::dvec3& v) { return glm::dot(v, v); };
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 ap = p - a;
    const double abAp = glm::dot(ab, ap);
    const double acAp = glm::dot(ac, ap);
    if (abAp <= 0 && acAp <= 0) return squareOf(ap);
    const glm::dvec3 bp = p - b;
    const double abBp = glm::dot(ab, bp);
    const double acBp = glm::dot(ac, bp);
    if (abBp >= 0 && acBp <= abBp) return squareOf(bp);
    const double besideC = abAp * acBp - abBp * acAp;
    if (besideC <= 0 && abAp >= 0 && abBp <= 0) {
        const double along = abAp > abBp ? abAp / (abAp - abBp) : 0;
        return squareOf(ap - ab * along);
    }
    const glm::dvec3 cp = p - c;
    const double abCp = glm::dot(ab, cp);
    const double acCp = glm::dot(ac, cp);
    if (acCp >= 0 && abCp <= acCp) return squareOf(cp);
    const double besideB = abCp * acAp - abAp * acCp;
    if (besideB <= 0 && acAp >= 0 && acCp <= 0) {
        const double along = acAp > acCp ? acAp / (acAp - acCp) : 0;
        return squareOf(ap - ac * along);
    }
    const double besideA = abBp * acCp - abCp * acBp;
    const double towardsC = acBp - abBp;
    const double towardsB = abCp - acCp;
    if (besideA <= 0 && towardsC >= 0 && towardsB >= 0) {
        const double sum = towardsC + towardsB;
        const double along = sum > 0 ? towardsC / sum : 0;
        return squareOf(bp - (c - b) * along);
    }
    const double scale = 1 / (besideA + besideB + besideC);
    const double v = std::clamp(besideB * scale, 0.0, 1.0);
    const double w = std::clamp(besideC * scale, 0.0, 1 - v);
    return squareOf(ap - ab * v - ac * w);
}

double squaredDistance(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 edge = b - a;
    const glm::dvec3 offset = p - a;
    const double length = glm::dot(edge, edge);
    const double along = length > 0 ? std::clamp(glm::dot(offset, edge) / length, 0.0, 1.0) : 0;
    const glm::dvec3 rest = offset - edge * along;
    return glm::dot(rest, rest);
}

} // namespace gnomon::proximity
