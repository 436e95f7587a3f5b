// A sundial under every light of data/lights: its shadow falls where a pencil and a ruler put it.
#include "core/json_file.h"
#include "path/camera_path.h"
#include "tests/pictures/pictured_model.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace gnomon::tests {
namespace {

const std::string kData = GNOMON_SOURCE_DIR "/data/";
constexpr double kDialHeight = 0.05; // of the dial above the ground
constexpr double kShade = 0.8;       // of what is lit, in the values of a screen: half of its light and less

/// The directions towards the light of all sets, each with the set's name.
std::vector<std::pair<std::string, glm::dvec3>> allLights() {
    std::vector<std::pair<std::string, glm::dvec3>> lights;
    for (const auto& entry : std::filesystem::directory_iterator(kData + "lights")) {
        const auto document = readJsonFile(entry.path());
        for (const auto& light : document["lights"])
            lights.emplace_back(
                entry.path().stem(),
                glm::dvec3(light[0].get<double>(), light[1].get<double>(), light[2].get<double>()));
    }
    return lights;
}

/// The brightness at the image of `point`.
double brightnessAt(const render::Picture& picture, const plan::View& view, const glm::dvec3& point) {
    const glm::dvec3 p = toCamera(cameraBasis(view.camera), point - view.camera.eye);
    const double u = p.x / (p.z * view.tanHalfX());
    const double v = p.y / (p.z * view.tanHalfY());
    const auto column = static_cast<int>((u + 1) / 2 * view.width);
    const auto row = static_cast<int>((1 - v) / 2 * view.height);
    return picture.at(column, row)[1];
}

TEST(Sundial, CastsItsShadowWhereGeometrySaysUnderEveryLight) {
    const ScratchFile model("sundial.gnm");
    build(kData + "models/sundial.ply", model.path());
    plan::View view;
    view.camera = path::readCamera(kData + "cameras/sundial_above.json");
    view.width = view.height = 512;
    const auto lights = allLights();
    ASSERT_GE(lights.size(), 15U);
    for (const Backend backend : {Backend::Software, Backend::Osmesa}) {
        PicturedModel sundial(model.path(), backend);
        for (const auto& [set, light] : lights) {
            view.towardsLight = light;
            const render::Picture picture = sundial.draw(view, 1).picture;
            const glm::dvec3 perHeight = glm::dvec3(light.x, 0, light.z) / light.y;
            const double reach = 4 * glm::length(perHeight);
            if (reach < 0.5) continue; // all but overhead: the shadow hides under the gnomon
            const std::string where = set + " " + std::to_string(light.x) + "," + std::to_string(light.z);
            const glm::dvec3 dial(0, kDialHeight, 0);
            // Along the middle of the shadow, on the dial, clear of the gnomon's foot and of its image from above.
            for (const double height : {1.6, 2.2, 2.8, 3.6}) {
                const glm::dvec3 dark = dial - perHeight * (height - kDialHeight);
                const glm::dvec3 lit = dial + perHeight * (height - kDialHeight);
                if (glm::length(perHeight) * height < 0.6 || glm::length(perHeight) * height > 4.8) continue;
                EXPECT_LT(brightnessAt(picture, view, dark), kShade * brightnessAt(picture, view, lit))
                    << where << ", height " << height;
            }
            const glm::dvec3 pastTip = dial - perHeight * 4.0 - glm::normalize(perHeight) * 0.3;
            if (glm::length(pastTip) > 4.8) continue;
            EXPECT_GT(brightnessAt(picture, view, pastTip), 0.9 * brightnessAt(picture, view, -pastTip)) << where;
        }
    }
}

} // namespace
} // namespace gnomon::tests
