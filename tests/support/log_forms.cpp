#include "tests/support/log_forms.h"

#include "shadow/partition/faces.h"

#include <algorithm>
#include <cmath>

namespace gnomon::shadow {

namespace {

/// ln(f/n), also where that is near 0.
double logDepthRatio(const ViewFrustum& frustum) {
    return std::log1p((frustum.far - frustum.near) / frustum.near);
}

} // namespace

double logStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight) {
    const double tanX = tanHalfX(frustum);
    const double tanY = tanHalfY(frustum);
    const double growth = logDepthRatio(frustum);
    double sum = frustum.aspect * std::abs(towardsLight.z);
    for (const Face face : sideFaces(frustum, towardsLight)) {
        const bool isLevel = face == Face::Top || face == Face::Bottom;
        // A face's width over its depth, and its height over the depth that it spans.
        const double area = isLevel ? 2 * tanX * std::hypot(1, tanY) : 2 * tanY * std::hypot(1, tanX);
        const double cosine = std::abs(glm::dot(outwardNormal(frustum, face), towardsLight));
        sum += growth * area / (4 * tanY * tanY) * cosine;
    }
    return sum;
}

double logShearedStorageFactor(const ViewFrustum& frustum, const glm::dvec3& towardsLight) {
    const double tanY = tanHalfY(frustum);
    const auto seen = [&](const glm::dvec3& p) { return glm::length(glm::cross(p, towardsLight)); };
    double sum = frustum.aspect * seen({1, 0, 0}) * seen({0, 1, 0});
    for (const Face face : sideFaces(frustum, towardsLight)) {
        const std::array<FitVertex, 4> vertices = faceVertices(frustum, face);
        const glm::dvec3 left = vertices[0].position / frustum.near;
        const glm::dvec3 right = vertices[1].position / frustum.near;
        const double growth = logDepthRatio(frustum) / (4 * tanY * tanY);
        sum += growth * seen(right - left) * std::max(seen(left), seen(right));
    }
    return sum;
}

} // namespace gnomon::shadow
