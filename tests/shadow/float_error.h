// How far positions in single precision move what a shadow map is asked.
#pragma once

#include "random_views.h"

#include <algorithm>

namespace gnomon::shadow {

/// By how many texels of 4096 `p` lands elsewhere in the image that executors get than its (s, t) in double say, where
/// positions are floats relative to `origin`.
inline double texelsOff(const ShadowMap& map, const glm::dvec3& origin, const glm::dvec3& p) {
    const FloatMapImage image = rounded(mapImage(map, relativeTo(map.lightClipFromCamera(), origin), glm::dvec3(0)));
    const MapTexel<float> found = texelAt(image, glm::vec3(p - origin));
    const glm::dvec2 off = glm::dvec2(found.column, found.row) - exactTexel(map, p);
    return glm::length(off / glm::dvec2(map.rectangle.width, map.rectangle.height)) * 4096;
}

struct FloatError {
    double fromTheOrigin = 0; // texels of 4096, positions relative to the maps' origins
    double fromTheEye = 0;    // and relative to the eye
};

/// The worst of points in `frustum` under random lights.
inline FloatError floatError(const ViewFrustum& frustum) {
    Random random(1);
    FloatError worst;
    for (int round = 0; round < 200; ++round) {
        ShadowView view;
        view.frustum = frustum;
        view.towardsLight = randomLight(random);
        const ShadowMapSetup setup = shadowMapSetup(view, {});
        for (int i = 0; i < 50; ++i) {
            const glm::dvec3 p = randomPointIn(random, frustum);
            const ShadowMap& map = setup.maps.at(setup.mapOf(p));
            worst.fromTheOrigin = std::max(worst.fromTheOrigin, texelsOff(map, map.origin, p));
            worst.fromTheEye = std::max(worst.fromTheEye, texelsOff(map, glm::dvec3(0), p));
        }
    }
    return worst;
}

} // namespace gnomon::shadow
