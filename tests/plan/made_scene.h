// A scene of boxes in the form that a plan receives, without geometry, for tests of the plan alone.
#pragma once

#include "core/depth_span.h"
#include "core/random.h"
#include "plan/plan_frame.h"

#include <algorithm>
#include <cmath>

namespace gnomon::plan {

/// Boxes at random places in a square, with the number of triangles of each.
struct MadeScene {
    explicit MadeScene(std::uint64_t seed) {
        Random random(seed);
        const std::uint64_t count = 40 + random.below(160);
        for (std::uint64_t i = 0; i < count; ++i) {
            const double x = random.uniform(-200, 200);
            const double z = random.uniform(-200, 200);
            const double width = random.uniform(1, 12);
            const double height = random.uniform(0.2, 20);
            const std::uint64_t triangles = 100 + random.below(8000);
            blocks.push_back({{{x, 0, z}, {x + width, height, z + width}}, triangles});
            bounds.add(blocks.back().box);
        }
    }

    /// Returns the result of a survey of `view`, with one entry per box.
    SceneFacts facts(const View& view) const {
        SceneFacts facts;
        facts.bounds = bounds;
        facts.visible = SceneFacts::Visible();
        facts.light = SceneFacts::Light();
        const CameraBasis basis = cameraBasis(view.camera);
        std::vector<DepthSpan>& lit = facts.light->lit;
        for (const SceneFacts::CasterBlock& block : blocks) {
            const Box box{block.box.min - view.camera.eye, block.box.max - view.camera.eye};
            facts.light->casters.push_back({box, block.triangles});
            const glm::dvec3 middle = toCamera(basis, box.center());
            const double reach = glm::dot(glm::abs(basis.view), box.extent() * 0.5);
            if (middle.z + reach <= 0 || std::abs(middle.x) > view.tanHalfX() * middle.z) continue;
            lit.push_back({std::max(0.01, middle.z - reach), middle.z + reach});
        }
        std::sort(lit.begin(), lit.end(), [](const DepthSpan& a, const DepthSpan& b) { return a.near < b.near; });
        for (const DepthSpan& span : lit) {
            if (!facts.visible->anything) facts.visible = {span.near, span.far, true};
            facts.visible->farthest = std::max(facts.visible->farthest, span.far);
        }
        return facts;
    }

    std::vector<SceneFacts::CasterBlock> blocks; // in world space
    Box bounds;
};

/// Returns a view at eye height or from a crane, with any light, including difficult directions.
template <class Source>
View madeViewFrom(Source& random) {
    View view;
    view.camera.eye.x = random.uniform(-150, 150);
    view.camera.eye.y = random.below(3) == 0 ? random.uniform(10, 60) : 1.7;
    view.camera.eye.z = random.uniform(-150, 150);
    const double yaw = random.uniform(0, 6.283);
    const double pitch = random.uniform(-0.5, 0.1);
    view.camera.target = view.camera.eye + glm::dvec3(std::sin(yaw), pitch, std::cos(yaw));
    view.camera.fovYRadians = random.uniform(0.5, 1.6);
    view.width = 400 + static_cast<int>(random.below(1200));
    view.height = 400 + static_cast<int>(random.below(800));
    view.towardsLight.x = random.uniform(-1, 1);
    view.towardsLight.y = random.uniform(0.02, 1);
    view.towardsLight.z = random.uniform(-1, 1);
    return view;
}

inline View madeView(std::uint64_t seed) {
    Random random(seed);
    return madeViewFrom(random);
}

} // namespace gnomon::plan
