// Seeded samples of views: what an image might show, from one spot to all of the frustum.
#pragma once

#include "random_views.h"

namespace gnomon::shadow {

/// Samples in up to six clumps and now and then all over `frustum`; some lie on its sides.
inline std::shared_ptr<const std::vector<glm::vec3>> randomSamples(
    Random& random, const ViewFrustum& frustum, int count) {
    std::vector<glm::vec3> samples;
    std::vector<glm::dvec3> clumps;
    for (std::uint64_t i = 0; i <= random.below(6); ++i)
        clumps.push_back(randomPointIn(random, frustum));
    const double size = std::pow(10.0, random.uniform(-3, 0));
    const bool isEverywhere = random.below(4) == 0;
    for (int i = 0; i < count; ++i) {
        glm::dvec3 p = randomPointIn(random, frustum);
        if (!isEverywhere) p = glm::mix(clumps[random.below(clumps.size())], p, size); // convex, so it stays within
        samples.emplace_back(p);
    }
    return std::make_shared<const std::vector<glm::vec3>>(std::move(samples));
}

/// A view with samples and options that ask for fitted maps.
struct FittedCase {
    ShadowView view;
    ShadowOptions options;
};

inline FittedCase randomFittedCase(Random& random, int samples) {
    FittedCase result{randomView(random), {}};
    result.options = randomOptions(random, result.view.frustum);
    result.options.scheme.warp.rule = WarpRule::Fitted;
    result.options.stabilized = false;
    result.view.samples = randomSamples(random, result.view.frustum, samples);
    return result;
}

} // namespace gnomon::shadow
