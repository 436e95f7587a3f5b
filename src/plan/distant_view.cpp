#include "plan/distant_view.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

View distantView(const View& view, const Box& bounds) {
    if (!view.camera.isParallel() || view.eyeMovedBack) return view;
    const CameraBasis basis = cameraBasis(view.camera);
    const double halfHeight = halfHeightAtTarget(view.camera);
    const double size =
        std::max(bounds.isEmpty() ? 0 : glm::length(bounds.extent()), 2 * halfHeight * std::max(1.0, view.aspect()));
    const glm::dvec3 middle = bounds.isEmpty() ? view.camera.target : bounds.center();
    const double distance = kDistantSizes * size;
    const double nearest = distance - 0.5 * size;
    View distant = view;
    distant.eyeMovedBack = distance - glm::dot(basis.view, middle - view.camera.eye);
    distant.camera.eye = view.camera.eye - basis.view * *distant.eyeMovedBack;
    distant.camera.target = distant.camera.eye + basis.view * nearest;
    distant.camera.fovYRadians = 2 * std::atan(halfHeight / nearest);
    return distant;
}

Quality distantQuality(const Quality& quality, const View& asked, const View& distant) {
    Quality result = quality;
    if (asked.eyeMovedBack || !distant.eyeMovedBack) return result;
    for (std::optional<double>* depth : {&result.near, &result.far})
        if (*depth) **depth += *distant.eyeMovedBack;
    return result;
}

} // namespace gnomon::plan
