// The light of the sky on the ground that nothing but its shadows shows, against the directions that a box hides.
#include "frame/accumulation.h"
#include "plan/light_directions.h"
#include "tests/support/drawn_model.h"
#include "tests/support/scene_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gnomon::frame {
namespace {

constexpr int kSkyParts = 128;
constexpr glm::dvec3 kLow{-3, 0, -4};
constexpr glm::dvec3 kHigh{3, 4, -1};

/// Whether the box between kLow and kHigh stands before `p` towards `way`.
bool isHiddenByBox(const glm::dvec3& p, const glm::dvec3& way) {
    double near = 0;
    double far = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (kLow[axis] - p[axis]) / way[axis];
        const double b = (kHigh[axis] - p[axis]) / way[axis];
        near = std::max(near, std::min(a, b));
        far = std::min(far, std::max(a, b));
    }
    return near < far;
}

/// The share of the light of level ground that the box takes of the sky.
double hiddenSky(const glm::dvec3& p) {
    double hidden = 0;
    double all = 0;
    for (int i = 0; i < kSkyParts; ++i) {
        const plan::SkyPart part = plan::skyPart(i, kSkyParts, plan::SkyModel::Uniform, {0, 1, 0});
        all += part.weight * part.direction.y;
        hidden += isHiddenByBox(p, part.direction) ? part.weight * part.direction.y : 0;
    }
    return hidden / all;
}

/// The plane under the box at the middle of a pixel, if that shows it and not the box.
std::optional<glm::dvec3> groundAt(const plan::View& view, int x, int y) {
    const CameraBasis basis = cameraBasis(view.camera);
    const glm::dvec3 ray = basis.view + ((2 * x + 1.0) / view.width - 1) * view.tanHalfX() * basis.right +
                           (1 - (2 * y + 1.0) / view.height) * view.tanHalfY() * basis.up;
    if (ray.y > -0.05 || isHiddenByBox(view.camera.eye, ray)) return std::nullopt;
    return view.camera.eye - ray * (view.camera.eye.y / ray.y);
}

render::Picture skyPicture(DrawnModel& model, const plan::View& view, bool hasGround) {
    plan::Quality quality;
    quality.shadows = plan::ShadowMode::Exact;
    quality.look.shading = plan::Shading::Lit;
    quality.look.ground = hasGround;
    quality.look.background = {plan::Background::Kind::Color, {255, 255, 255}};
    quality.look.ambient = 10; // so that the sky counts
    quality.sky = {kSkyParts};
    FrameOptions options;
    options.isAccumulated = true;
    const Frame frame = model.draw(view, quality, options);
    EXPECT_EQ(frame.plan.sky.directions, hasGround ? kSkyParts : 0) << "a solid by itself hides none of it";
    Accumulation mean;
    mean.begin(model.renderer(), frame, 1);
    while (mean.samples() < mean.wanted())
        mean.add();
    return mean.picture();
}

double linearShare(std::uint8_t level) {
    const double display = level / 255.0;
    return display <= 0.04045 ? display / 12.92 : std::pow((display + 0.055) / 1.055, 2.4);
}

tests::TinyModel boxModel() {
    tests::SceneMesh scene;
    scene.addBox(kLow, kHigh);
    return scene.model();
}

plan::View groundView(const Camera& camera) {
    plan::View view;
    view.width = 96;
    view.height = 64;
    view.camera = camera;
    view.towardsLight = {0, 1, 4};
    return view;
}

TEST(GroundLight, IsWhatABoxLeavesOfTheSky) {
    DrawnModel model(boxModel());
    const plan::View view = groundView({{6, 9, 14}, {0, 0, 0}, {0, 1, 0}, 1});
    const double sun = 2.23 / std::sqrt(17.0); // of green, as light_model.cpp has it
    const double rest = 10 * 0.045 * (1 - 1 / std::sqrt(1.49));
    const double sky = 10 * 0.51 / (10 * 0.51 + sun + rest);
    const render::Picture picture = skyPicture(model, view, true);
    const render::Picture without = skyPicture(model, view, false);
    std::vector<double> errors;
    double darkest = 1;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::optional<glm::dvec3> p = groundAt(view, x, y);
            if (!p || without.at(x, y)[1] != 255) continue; // or the box's border runs through the pixel
            const double left = linearShare(picture.at(x, y)[1]);
            const double sunlit = isHiddenByBox(*p, view.light().unit()) ? 0 : sun / (10 * 0.51 + sun + rest);
            const double wanted = rest / (10 * 0.51 + sun + rest) + sunlit + sky * (1 - hiddenSky(*p));
            errors.push_back(std::abs(left - wanted));
            darkest = std::min(darkest, wanted);
        }
    ASSERT_GT(errors.size(), 2500U);
    EXPECT_LT(darkest, 0.6);
    std::sort(errors.begin(), errors.end());
    EXPECT_LE(errors[errors.size() * 9 / 10], 0.01); // of a screen's level, and of a pixel's width
    EXPECT_LE(errors.back(), 0.5) << "at the box's foot";
}

// From where all that the model can hide of the sky is seen, no border shows where the plane ends.
TEST(GroundLight, EndsWhereTheModelHidesNoneOfTheSky) {
    DrawnModel model(boxModel());
    const plan::View view = groundView({{0, 40, 90}, {0, 0, 40}, {0, 1, 0}, 0.7});
    const render::Picture picture = skyPicture(model, view, true);
    int looked = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const std::optional<glm::dvec3> p = groundAt(view, x, y);
            if (!p || p->z < 24) continue;
            ++looked;
            EXPECT_GE(picture.at(x, y)[1], 253) << x << "," << y;
        }
    EXPECT_GT(looked, 1000);
}

} // namespace
} // namespace gnomon::frame
