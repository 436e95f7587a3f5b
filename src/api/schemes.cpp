#include "api/gnomon.h"
#include "core/angle.h"
#include "core/error.h"
#include "theory/scheme_table.h"

namespace gnomon::api {

std::vector<ShadowScheme> shadowSchemes(
    double near, double far, double fovYDegrees, double aspect, const std::array<double, 3>& towardsLight) {
    shadow::ViewFrustum frustum;
    frustum.near = near;
    frustum.far = far;
    frustum.aspect = aspect;
    frustum.halfFovYRadians = radiansFromDegrees(fovYDegrees / 2);
    shadow::requireValid(frustum);
    const glm::dvec3 light(towardsLight[0], towardsLight[1], towardsLight[2]);
    const double length = glm::length(light);
    if (!(length > 0) || !std::isfinite(length))
        throw Error("towardsLight", "invalid direction", "three finite numbers that are not all 0", "other numbers");
    std::vector<ShadowScheme> result;
    for (const theory::SchemeRow& row : theory::schemeTable(frustum, light / length))
        result.push_back(
            {row.scheme, row.warp, row.slices, static_cast<int>(row.maps), row.storageFactor, row.worstX, row.worstZ});
    return result;
}

} // namespace gnomon::api
