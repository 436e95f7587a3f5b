// Where a closed convex solid is all that is seen, nothing of it hides the sky: its far sides are hidden themselves.
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

namespace gnomon::frame {
namespace {

/// From how many directions the sky's light is planned to come over `scene`, asked for 64.
int skyDirectionsOver(const tests::SceneMesh& scene, const std::function<void(plan::View&)>& change = {}) {
    plan::View view;
    view.width = view.height = 64;
    view.camera.eye = {3, 7, 9};
    view.camera.target = {0, 1, 0};
    if (change) change(view);
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.look.shading = plan::Shading::Lit;
    quality.sky.directions = 64;
    DrawnModel model(scene.model());
    return model.draw(view, quality).plan.sky.directions;
}

tests::SceneMesh crate() {
    tests::SceneMesh scene;
    scene.addBox({-1, 0, -1}, {1, 2, 1});
    return scene;
}

/// The sides of a box but for its first `missing`: the lid, the floor.
tests::SceneMesh sidesOfBox(int missing) {
    tests::SceneMesh scene;
    if (missing < 1) scene.addQuad({-1, 2, -1}, {0, 0, 2}, {2, 0, 0});
    if (missing < 2) scene.addQuad({-1, 0, -1}, {2, 0, 0}, {0, 0, 2});
    scene.addQuad({-1, 0, -1}, {0, 2, 0}, {2, 0, 0});
    scene.addQuad({-1, 0, 1}, {2, 0, 0}, {0, 2, 0});
    scene.addQuad({-1, 0, -1}, {0, 0, 2}, {0, 2, 0});
    scene.addQuad({1, 0, -1}, {0, 2, 0}, {0, 0, 2});
    return scene;
}

TEST(ClosedSolid, HidesNoSkyFromItself) {
    EXPECT_EQ(skyDirectionsOver(crate()), 0);
    EXPECT_EQ(skyDirectionsOver(sidesOfBox(0)), 0);
    EXPECT_EQ(skyDirectionsOver(crate(), [](plan::View& view) { view.camera.eye = {0, -9, 1}; }), 0);
}

TEST(ClosedSolid, IsOneOnlyWhereItIsClosedConvexWholeAndSeenFromOutside) {
    EXPECT_EQ(skyDirectionsOver(sidesOfBox(1)), 64) << "without a lid";
    EXPECT_EQ(skyDirectionsOver(sidesOfBox(2)), 64) << "a tube, whose sides' areas cancel out";
    tests::SceneMesh two = crate();
    two.addBox({3, 0, -1}, {4, 1, 1});
    EXPECT_EQ(skyDirectionsOver(two), 64) << "one shadows the other";
    tests::SceneMesh bent = crate();
    bent.addBox({1, 0, -1}, {2, 1, 1});
    EXPECT_EQ(skyDirectionsOver(bent), 64) << "not convex";
    EXPECT_EQ(skyDirectionsOver(crate(), [](plan::View& view) { view.camera.eye = {0.5, 1, 0.5}; }), 64) << "inside";
    EXPECT_EQ(skyDirectionsOver(crate(), [](plan::View& view) { view.camera.fovYRadians = 0.1; }), 64)
        << "who knows what else there is";
    const auto cut = [](plan::View& view) { view.sections = {{{0, -1, 0}, 1}}; };
    EXPECT_EQ(skyDirectionsOver(crate(), cut), 64) << "cut open";
}

} // namespace
} // namespace gnomon::frame
