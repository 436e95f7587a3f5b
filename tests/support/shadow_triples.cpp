#include "tests/support/shadow_triples.h"

#include "core/random.h"

#include <array>
#include <cmath>

namespace gnomon::tests {

namespace {

glm::dvec3 within(Random& random, const Box& bounds) {
    const double x = random.uniform(0.1, 0.9);
    const double y = random.uniform(0.1, 0.9);
    const double z = random.uniform(0.1, 0.9);
    return bounds.min + glm::dvec3(x, y, z) * bounds.extent();
}

/// A horizontal unit direction; no libm, so that it is the same everywhere.
glm::dvec3 heading(Random& random) {
    for (;;) {
        const double x = random.uniform(-1, 1);
        const double z = random.uniform(-1, 1);
        const double size = std::sqrt(x * x + z * z);
        if (size > 0.1 && size <= 1) return glm::dvec3(x, 0, z) / size;
    }
}

Camera pose(Random& random, const Box& bounds, std::uint64_t kind) {
    const double extent = glm::length(bounds.extent());
    Camera camera;
    camera.target = within(random, bounds);
    const glm::dvec3 aside = heading(random);
    if (kind == 0) { // from far out
        const double up = random.uniform(0.1, 0.9);
        camera.eye = camera.target + extent * random.uniform(0.6, 1.6) * glm::normalize(aside + glm::dvec3(0, up, 0));
    } else if (kind == 1) { // at eye height, over flat ground
        camera.eye = within(random, bounds);
        camera.eye.y = bounds.min.y + random.uniform(0.01, 0.04) * extent;
        camera.target = camera.eye + aside * extent;
        camera.target.y = camera.eye.y - random.uniform(0, 0.1) * extent;
    } else { // close above the model
        const double up = random.uniform(0.4, 3);
        camera.eye = camera.target + extent * random.uniform(0.1, 0.4) * glm::normalize(aside + glm::dvec3(0, up, 0));
    }
    return camera;
}

glm::dvec3 light(Random& random, const Camera& camera, std::uint64_t kind) {
    const glm::dvec3 aside = heading(random);
    const double up = random.uniform(0.15, 2);
    switch (kind) {
    case 0:
        return {0, 1, 0};
    case 1: // near the horizon
        return aside + glm::dvec3(0, 0.05, 0);
    case 2: // behind the viewer
        return camera.eye - camera.target + glm::dvec3(0, 0.02 * up, 0);
    default:
        return aside + glm::dvec3(0, up, 0);
    }
}

plan::Quality scheme(Random& random, std::uint64_t index) {
    using shadow::WarpRule;
    constexpr std::array kRules = {
        WarpRule::Auto, WarpRule::None, WarpRule::Lspsm, WarpRule::Minimax, WarpRule::Psm, WarpRule::Tsm};
    constexpr std::array kSlices = {1, 2, 3, 4, 8};
    constexpr std::array kFilters = {0, 0, 2, 3};
    plan::Quality quality;
    quality.warp.rule = kRules[index % kRules.size()];
    if (index % (2 * kRules.size()) == 11) quality.warp.tsmFocus = 1e-9; // a TSM as steep as a map may be
    quality.zPartitions = kSlices[random.below(kSlices.size())];
    quality.filter = kFilters[random.below(kFilters.size())];
    quality.facePartitions = index % 4 == 3 ? plan::Choice::On : plan::Choice::Off;
    quality.stabilize = index % 10 == 9;
    return quality;
}

} // namespace

ShadowTriple shadowTriple(const Box& bounds, std::uint64_t index, int side, int texels) {
    Random random(index * 7919 + 1);
    ShadowTriple triple;
    triple.view.width = triple.view.height = side;
    triple.view.camera = pose(random, bounds, index % 3);
    triple.view.towardsLight = light(random, triple.view.camera, index % 8);
    triple.quality = scheme(random, index);
    triple.quality.shadowTexelsWidth = triple.quality.shadowTexelsHeight = texels;
    return triple;
}

plan::PointLight lampFor(const Box& bounds, const plan::View& view, std::uint64_t index) {
    Random random(index * 6367 + 5);
    const glm::dvec3 extent = bounds.extent();
    plan::PointLight lamp;
    lamp.reach = glm::length(extent) / 4;
    lamp.at = bounds.min + extent * glm::dvec3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
    constexpr std::uint64_t kKinds = 6;
    if (index % kKinds == 1) lamp.at = bounds.max;
    if (index % kKinds == 2) lamp.at.y = bounds.min.y;
    if (index % kKinds == 3) lamp.at = view.camera.eye;
    if (index % kKinds == 4) lamp.at = bounds.center() + 2.0 * (lamp.at - bounds.center());
    if (index % kKinds == 5)
        lamp.at = bounds.center() + std::pow(10, random.uniform(0, 6)) * (lamp.at - bounds.center());
    return lamp;
}

ShadowTriple withDefaults(const ShadowTriple& triple) {
    ShadowTriple result = triple;
    result.quality = plan::Quality();
    result.quality.shadowTexelsWidth = triple.quality.shadowTexelsWidth;
    result.quality.shadowTexelsHeight = triple.quality.shadowTexelsHeight;
    return result;
}

std::string describe(const ShadowTriple& triple) {
    const plan::Quality& quality = triple.quality;
    return std::string(shadow::name(quality.warp.rule)) + " k=" + std::to_string(quality.zPartitions.value_or(0)) +
           (quality.facePartitions == plan::Choice::On ? " faces" : "") + (quality.stabilize ? " stable" : "") +
           " filter=" + std::to_string(quality.filter);
}

} // namespace gnomon::tests
