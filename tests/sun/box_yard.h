// A test scene for the daylight computation.
#pragma once

#include "core/random.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <cmath>
#include <memory>
#include <vector>

namespace gnomon::sun {

/// Boxes on a plain, with lights from all directions of the sky.
struct BoxYard {
    explicit BoxYard(std::uint64_t seed) : random(seed) {
        tests::SceneMesh scene;
        scene.addGround(40, 8);
        for (int i = 0; i < 12; ++i) {
            const glm::dvec3 low(random.uniform(-12, 10), random.uniform(-0.5, 4), random.uniform(-12, 10));
            scene.addBox(low, low + glm::dvec3(random.uniform(0.2, 4), random.uniform(0.2, 4), random.uniform(0.2, 4)));
        }
        model = std::make_unique<frame::DrawnModel>(scene.model());
        view.width = 120;
        view.height = 90;
        view.camera = {{random.uniform(-9, 9), random.uniform(8, 30), random.uniform(-9, 9)}, {0, 0, 0}, {0, 0, 1}, 1};
        for (int i = 0; i < 12; ++i) {
            const double angle = random.uniform(0, 6.28);
            lights.push_back(roundedLight({std::cos(angle), random.uniform(0.02, 3), std::sin(angle)}));
        }
    }

    Random random;
    std::unique_ptr<frame::DrawnModel> model;
    plan::View view;
    std::vector<IntegerLight> lights;
};

} // namespace gnomon::sun
