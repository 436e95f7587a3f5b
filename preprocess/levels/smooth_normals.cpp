#include "preprocess/levels/smooth_normals.h"

#include "hierarchy/octahedral.h"

#include <cmath>

namespace gnomon::levels {

namespace {

constexpr double kCreaseCosine = 0.766; // cosine of 40 degrees, the max angle between a face and the mean normal

glm::dvec3 toVector(const hierarchy::GridPoint& p) {
    return {p.x, p.y, p.z};
}

} // namespace

std::vector<std::uint32_t> smoothNormals(
    const std::vector<hierarchy::GridPoint>& positions, const std::vector<simplify::Triangle>& triangles) {
    std::vector<glm::dvec3> sum(positions.size(), glm::dvec3(0));
    const auto faceNormal = [&](const simplify::Triangle& t) {
        const glm::dvec3 a = toVector(positions[t[0]]);
        return glm::cross(toVector(positions[t[1]]) - a, toVector(positions[t[2]]) - a);
    };
    for (const simplify::Triangle& t : triangles) {
        const glm::dvec3 n = faceNormal(t);
        for (const std::uint32_t p : t)
            sum[p] += n;
    }
    std::vector<std::uint32_t> codes(positions.size());
    for (std::size_t p = 0; p < positions.size(); ++p)
        codes[p] = hierarchy::packNormal(sum[p]);
    for (const simplify::Triangle& t : triangles) {
        const glm::dvec3 n = faceNormal(t);
        const double length = glm::length(n);
        for (const std::uint32_t p : t)
            if (glm::dot(n, sum[p]) < kCreaseCosine * length * glm::length(sum[p])) codes[p] = hierarchy::kNoNormal;
    }
    return codes;
}

} // namespace gnomon::levels
