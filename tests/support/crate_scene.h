// A crate on a plain, with a view and settings for its maps.
#pragma once

#include "plan/frame_plan.h"
#include "tests/support/scene_mesh.h"

namespace gnomon::frame {

inline tests::SceneMesh crateOnGround(const glm::dvec3& origin = glm::dvec3(0)) {
    tests::SceneMesh scene(origin);
    scene.addGround(64, 16);
    scene.addBox({-1, 0, -1}, {1, 2, 1});
    return scene;
}

inline plan::View overGround(const glm::dvec3& origin = glm::dvec3(0)) {
    plan::View view;
    view.width = view.height = 160;
    view.camera.eye = origin + glm::dvec3(0, 6, 12);
    view.camera.target = origin;
    view.towardsLight = {1, 1, 0};
    return view;
}

/// Returns a quality with `slices` warped maps that share 512 x 512 texels.
inline plan::Quality inSlices(int slices) {
    plan::Quality quality;
    quality.zPartitions = slices;
    quality.shadowTexelsWidth = quality.shadowTexelsHeight = 512;
    return quality;
}

} // namespace gnomon::frame
