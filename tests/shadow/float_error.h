// The error of shadow lookups due to positions in single precision.
#pragma once

#include "tests/support/random_views.h"

#include <algorithm>

namespace gnomon::shadow {

/// Returns the distance, in texels of a map with 4096 texels, between the position of `p` in the uploaded image and its
/// (s, t) in double precision. Positions are floats relative to `origin`.
inline double texelsOff(const ShadowMap& map, const glm::dvec3& origin, const glm::dvec3& p) {
    const FloatMapImage image = rounded(mapImage(map, relativeTo(map.lightClipFromCamera(), origin), glm::dvec3(0)));
    const MapTexel<float> found = texelAt(image, glm::vec3(p - origin));
    const glm::dvec2 off = glm::dvec2(found.column, found.row) - exactTexel(map, p);
    return glm::length(off / glm::dvec2(map.rectangle.width, map.rectangle.height)) * 4096;
}

struct FloatError {
    double fromTheOrigin = 0; // positions relative to the maps' origins, in texels of 4096
    double fromTheEye = 0;    // positions relative to the eye
};

/// Returns the max error over random points in `frustum` and random lights.
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
