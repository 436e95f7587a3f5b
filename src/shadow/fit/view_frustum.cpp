#include "shadow/fit/view_frustum.h"

#include "core/error.h"
#include "core/limit_error.h"

#include <cmath>
#include <string>

namespace gnomon::shadow {

double tanHalfY(const ViewFrustum& frustum) {
    return std::tan(frustum.halfFovYRadians);
}

double tanHalfX(const ViewFrustum& frustum) {
    return frustum.aspect * tanHalfY(frustum);
}

ViewFrustum slice(const ViewFrustum& frustum, double near, double far) {
    ViewFrustum part = frustum;
    part.near = near;
    part.far = far;
    return part;
}

std::array<glm::dvec3, 8> corners(const ViewFrustum& frustum) {
    const double tanY = tanHalfY(frustum);
    const double tanX = frustum.aspect * tanY;
    std::array<glm::dvec3, 8> result{};
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double depth = (i & 4U) != 0 ? frustum.far : frustum.near;
        const double x = (i & 1U) != 0 ? tanX : -tanX;
        const double y = (i & 2U) != 0 ? tanY : -tanY;
        result[i] = glm::dvec3(x * depth, y * depth, depth);
    }
    return result;
}

double imageBeamWidth(const ViewFrustum& frustum, double depth, double heightPixels) {
    return 2 * tanHalfY(frustum) * depth / heightPixels;
}

void requireValid(const ViewFrustum& frustum) {
    const bool depthsHold = frustum.near > 0 && frustum.far > frustum.near && std::isfinite(frustum.far);
    if (!depthsHold)
        throw Error(
            "view frustum",
            "depth range",
            "0 < near < far",
            "near " + std::to_string(frustum.near) + ", far " + std::to_string(frustum.far));
    constexpr double kHalfPi = 1.5707963267948966;
    if (!(frustum.halfFovYRadians > 0 && frustum.halfFovYRadians < kHalfPi))
        throw LimitError(
            Limit::FieldOfView,
            {"view frustum",
             "half the vertical angle in radians",
             "between 0 and pi/2",
             std::to_string(frustum.halfFovYRadians)});
    if (!(frustum.aspect > 0 && std::isfinite(frustum.aspect)))
        throw Error("view frustum", "aspect", "a positive number", std::to_string(frustum.aspect));
}

} // namespace gnomon::shadow
