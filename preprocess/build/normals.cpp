#include "preprocess/build/normals.h"

#include <algorithm>
#include <cmath>

namespace gnomon::preprocess {

namespace {

constexpr double kCreaseCosine = 0.766; // 40 degrees from the mean

std::uint32_t snorm16(double value) {
    const double scaled = std::floor(std::clamp(value, -1.0, 1.0) * 32767.0 + 0.5);
    return static_cast<std::uint32_t>(static_cast<std::uint16_t>(static_cast<std::int16_t>(scaled)));
}

double fromSnorm16(std::uint32_t bits) {
    return std::max(-1.0, static_cast<double>(static_cast<std::int16_t>(static_cast<std::uint16_t>(bits))) / 32767.0);
}

double signOf(double value) {
    return value < 0 ? -1.0 : 1.0;
}

glm::dvec3 toVector(const GridPoint& p) {
    return {p.x, p.y, p.z};
}

} // namespace

std::uint32_t encodeNormal(const glm::dvec3& direction) {
    const double sum = std::abs(direction.x) + std::abs(direction.y) + std::abs(direction.z);
    if (!(sum > 0) || !std::isfinite(sum)) return hierarchy::kNoNormal;
    double x = direction.x / sum;
    double y = direction.y / sum;
    if (direction.z < 0) {
        const double foldedX = (1 - std::abs(y)) * signOf(x);
        y = (1 - std::abs(x)) * signOf(y);
        x = foldedX;
    }
    return snorm16(x) | snorm16(y) << 16U;
}

glm::dvec3 decodeNormal(std::uint32_t code) {
    if (code == hierarchy::kNoNormal) return glm::dvec3(0);
    glm::dvec3 n(fromSnorm16(code & 0xFFFFU), fromSnorm16(code >> 16U), 0);
    n.z = 1 - std::abs(n.x) - std::abs(n.y);
    if (n.z < 0) {
        const double x = n.x;
        n.x = (1 - std::abs(n.y)) * signOf(x);
        n.y = (1 - std::abs(x)) * signOf(n.y);
    }
    return n / glm::length(n);
}

std::vector<std::uint32_t> smoothNormals(
    const std::vector<GridPoint>& positions, const std::vector<Triangle>& triangles) {
    std::vector<glm::dvec3> sum(positions.size(), glm::dvec3(0));
    const auto faceNormal = [&](const Triangle& t) {
        const glm::dvec3 a = toVector(positions[t[0]]);
        return glm::cross(toVector(positions[t[1]]) - a, toVector(positions[t[2]]) - a);
    };
    for (const Triangle& t : triangles) {
        const glm::dvec3 n = faceNormal(t);
        for (const std::uint32_t p : t)
            sum[p] += n;
    }
    std::vector<std::uint32_t> codes(positions.size());
    for (std::size_t p = 0; p < positions.size(); ++p)
        codes[p] = encodeNormal(sum[p]);
    for (const Triangle& t : triangles) {
        const glm::dvec3 n = faceNormal(t);
        const double length = glm::length(n);
        for (const std::uint32_t p : t)
            if (glm::dot(n, sum[p]) < kCreaseCosine * length * glm::length(sum[p])) codes[p] = hierarchy::kNoNormal;
    }
    return codes;
}

} // namespace gnomon::preprocess
