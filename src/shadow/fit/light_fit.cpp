#include "shadow/fit/light_fit.h"

#include "core/check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::shadow {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moves the origin of the coordinate zeta to the min z of the region. The zeta of each point must be its z before the
/// call.
void startZetaAtZero(LightFit& fit) {
    double minZeta = kInfinity;
    double maxZeta = -kInfinity;
    for (const FitPoint& point : fit.points()) {
        minZeta = std::min(minZeta, point.zeta);
        maxZeta = std::max(maxZeta, point.zeta);
    }
    for (std::size_t i = 0; i < fit.count; ++i)
        fit.storage[i].zeta -= minZeta;
    fit.zMin += minZeta;
    fit.length = maxZeta - minZeta;
}

} // namespace

double LightFit::boundedLength() const {
    double minZeta = kInfinity;
    double maxZeta = -kInfinity;
    for (const FitPoint& point : points()) {
        if (point.end == DepthEnd::WithoutBound) continue;
        minZeta = std::min(minZeta, point.zeta);
        maxZeta = std::max(maxZeta, point.zeta);
    }
    return maxZeta - minZeta;
}

LightFit fitRegion(const LightFrame& frame, const ViewFrustum& slice, std::span<const FitVertex> vertices) {
    GNOMON_CHECK_OP(vertices.size(), >=, std::size_t{1});
    GNOMON_CHECK_OP(vertices.size(), <=, LightFit::kCapacity);
    LightFit fit;
    fit.frame = frame;
    fit.slice = slice;
    const auto minZeta =
        std::min_element(vertices.begin(), vertices.end(), [&](const FitVertex& a, const FitVertex& b) {
            return glm::dot(frame.z, a.position) < glm::dot(frame.z, b.position);
        });
    fit.zMin = glm::dot(frame.z, minZeta->position);
    for (const FitVertex& vertex : vertices) {
        const glm::dvec3 p = toLight(frame, vertex.position);
        // zeta is computed from the difference of positions. In a thin view, near corners are close to each other and
        // far from the eye. The difference of two z values would then lose precision.
        const double zeta = glm::dot(frame.z, vertex.position - minZeta->position);
        fit.storage[fit.count++] = {p.x, p.y, zeta, vertex.position.z, vertex.end};
    }
    startZetaAtZero(fit);
    return fit;
}

LightFit fitSlice(const LightFrame& frame, const ViewFrustum& slice) {
    const std::array<glm::dvec3, 8> points = corners(slice);
    std::array<FitVertex, 8> vertices;
    for (std::size_t i = 0; i < points.size(); ++i)
        vertices[i] = {points[i], i < 4 ? DepthEnd::Near : DepthEnd::Far};
    return fitRegion(frame, slice, vertices);
}

LightFit rolled(const LightFit& fit, double radians) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    LightFit result = fit;
    result.frame = rolled(fit.frame, radians);
    result.zMin = 0;
    for (std::size_t i = 0; i < fit.count; ++i) {
        const FitPoint& from = fit.storage[i];
        const double z = from.zeta + fit.zMin;
        result.storage[i].x = c * from.x - s * z;
        result.storage[i].zeta = c * z + s * from.x;
    }
    startZetaAtZero(result);
    return result;
}

double rowLength(double kappa, double length, RowSpacing rows) {
    if (rows == RowSpacing::Even || kappa == 0) return length / (1 + kappa * length);
    return std::log1p(kappa * length) / kappa;
}

WarpedExtent warpedExtent(const LightFit& fit, double kappa) {
    WarpedExtent extent{kInfinity, -kInfinity};
    for (const FitPoint& point : fit.points()) {
        const double u = point.x / (1 + kappa * point.zeta);
        extent.min = std::min(extent.min, u);
        extent.max = std::max(extent.max, u);
    }
    return extent;
}

Aliasing worstAliasing(const LightFit& fit, double kappa) {
    WarpedExtent extent{kInfinity, -kInfinity};
    double worstX = 0; // max of (1 + kappa zeta) / depth
    double worstZ = 0; // max of (1 + kappa zeta)^2 / depth, or of (1 + kappa zeta) / depth with logarithmic rows
    for (const FitPoint& point : fit.points()) {
        const double w = 1 + kappa * point.zeta;
        const double u = point.x / w;
        extent.min = std::min(extent.min, u);
        extent.max = std::max(extent.max, u);
        if (point.end == DepthEnd::WithoutBound) continue;
        const double ratio = w / point.depth;
        worstX = std::max(worstX, ratio);
        worstZ = std::max(worstZ, fit.rows == RowSpacing::Even ? ratio * w : ratio);
    }
    const double twoTan = 2 * tanHalfY(fit.slice);
    return {extent.width() * worstX / twoTan, rowLength(kappa, fit.length, fit.rows) * worstZ / twoTan};
}

double storageFactor(const LightFit& fit, double kappa) {
    const Aliasing worst = worstAliasing(fit, kappa);
    return worst.x * worst.z;
}

double worstShearedAliasing(const LightFit& fit, double kappa) {
    const WarpedExtent extent = warpedExtent(fit, kappa);
    const double leaning = lean(fit.frame);
    const double shear = std::max(std::abs(kappa * extent.min + leaning), std::abs(kappa * extent.max + leaning));
    const double straight = worstAliasing(fit, kappa).z;
    const bool isEven = fit.rows == RowSpacing::Even;
    if (isEven && shear > std::sqrt(2.0)) return straight * std::sqrt(1 + shear * shear);
    double worst = 0;
    for (const FitPoint& point : fit.points()) {
        if (point.end == DepthEnd::WithoutBound) continue;
        const double w = 1 + kappa * point.zeta;
        const double tilt = kappa * point.x / w + leaning;
        worst = std::max(worst, (isEven ? w * w : w) / point.depth * std::sqrt(1 + tilt * tilt));
    }
    return rowLength(kappa, fit.length, fit.rows) * worst / (2 * tanHalfY(fit.slice));
}

} // namespace gnomon::shadow
