// Colours that tell heights and slopes, pixel by pixel against the view's own geometry.
#include "executor/overlay/color_map.h"
#include "frame/drawn_model.h"
#include "hierarchy/scene_mesh.h"
#include "measure/value_picture.h"
#include "settings/value_colors.h"

#include <gtest/gtest.h>

namespace gnomon::measure {
namespace {

using settings::ColorBy;

TEST(ValueColors, ReadTheirRange) {
    const auto range = settings::valueRange();
    EXPECT_EQ(range.read("-1.5,2e3"), (std::array{-1.5, 2000.0}));
    for (const char* wrong : {"", "1", "2,1", "1,1", "a,2", "1,nan", "1,2,3"})
        EXPECT_FALSE(range.read(wrong)) << wrong;
    EXPECT_EQ(range.write({-1.5, 2000}), "-1.5,2000");
}

TEST(ValueColors, SlopeAndHeightAreThoseOfTheWorldsUp) {
    const glm::dvec3 up(0, 0, 7);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Height, {1, 2, 3}, {1, 0, 0}, up), 3);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Slope, {1, 2, 3}, {1, 0, 0}, up), 90);
    EXPECT_DOUBLE_EQ(valueOf(ColorBy::Slope, {1, 2, 3}, {0, 0, -1}, up), 0);
    EXPECT_NEAR(valueOf(ColorBy::Slope, {}, glm::normalize(glm::dvec3(1, 0, 1)), up), 45, 1e-12);
    EXPECT_EQ(heightRange({{-1, -2, -3}, {4, 5, 6}}, up), (std::array{-3.0, 6.0}));
    EXPECT_EQ(heightRange({{-1, -2, -3}, {4, 5, 6}}, {-2, 0, 0}), (std::array{-4.0, 1.0}));
}

TEST(ValueColors, EachPixelHasTheColourOfWhereItsRayMeetsTheGround) {
    const glm::dvec3 far(500000, 5000000, 300); // as of UTM, where floats know metres only
    tests::SceneMesh scene(far);
    scene.addQuad({-8, 0, -8}, {16, 4, 0}, {0, 0, 16}); // rises by a quarter along x
    frame::DrawnModel model(scene.model());
    plan::View view;
    view.width = view.height = 64;
    view.camera = {far + glm::dvec3(0, 30, 0.1), far, {0, 0, -1}, 0.5};
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Off;
    frame::FrameOptions options;
    options.wantsSurfaces = true;
    const frame::Frame frame = model.draw(view, quality, options);
    settings::ValueColors colors;
    colors.by = ColorBy::Height;
    colors.map = plan::ColorMap::Grey;
    executor::Picture picture = model.executor().picture();
    colorByValues(colors, model.renderer(), frame, picture);
    const Box bounds = model.file().summary().bounds;
    const CameraBasis basis = cameraBasis(view.camera);
    int compared = 0;
    for (int y = 0; y < 32; ++y) // the legend lies below
        for (int x = 0; x < 64; ++x) {
            const glm::dvec3 ray = basis.view + ((x + 0.5) / 32 - 1) * view.tanHalfX() * basis.right +
                                   (1 - (y + 0.5) / 32) * view.tanHalfY() * basis.up;
            const glm::dvec3 eye = view.camera.eye - far;
            const double t = (eye.y - eye.x / 4 - 2) / (ray.x / 4 - ray.y); // on y = 2 + x / 4
            const glm::dvec3 p = eye + t * ray;
            if (std::max(std::abs(p.x), std::abs(p.z)) > 7.9) continue;
            const double part = (p.y + far.y - bounds.min.y) / (bounds.max.y - bounds.min.y);
            const double grey = 255 * (0.15 + 0.8 * part);
            EXPECT_NEAR(picture.at(x, y)[0], grey, 1.01) << x << ", " << y;
            ++compared;
        }
    EXPECT_GT(compared, 500);
}

} // namespace
} // namespace gnomon::measure
