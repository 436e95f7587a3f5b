#include "render/light/light_model.h"

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

// Colours of the light sources in linear RGB. The sun is warmer than the sky, and light reflected from the ground is
// even warmer. Their sum is nearly neutral, so grey surfaces in full light stay grey. A white surface in full light
// has nine tenths of the max brightness of a screen.
constexpr glm::vec3 kSun{2.3F, 2.23F, 2.12F};
constexpr glm::vec3 kSky{0.47F, 0.51F, 0.57F};
constexpr glm::vec3 kGround{0.1F, 0.09F, 0.08F};
constexpr float kFill = 0.22F; // weak headlight, which shows curvature where all other light is uniform
/// Tilt of the sky's brightest direction from up towards the azimuth of the sun, because the sky is brightest near the
/// sun.
constexpr double kLean = 0.7;

// Parameters of the headlight. Its light decreases steeply with the angle, so that walls, floor and ceiling of the
// same colour are distinguishable. The additional ambient light is brighter above than below, and brighter on the
// right than on the left.
constexpr float kHeadlight = 4.5F;
constexpr float kDim = 0.26F;
constexpr float kDimTilt = 0.22F;
constexpr double kDimLean = 0.6;

glm::dvec3 skyAxis(const plan::View& view) {
    const glm::dvec3 up = glm::normalize(view.up);
    const glm::dvec3 light = glm::normalize(view.towardsLight);
    return glm::normalize(up + kLean * (light - up * glm::dot(light, up)));
}

} // namespace

float displayFromLinear(float linear) {
    const auto& k = srgb::kToDisplay;
    const float root = std::sqrt(linear);
    const float curve = k[0] + root * (k[1] + root * (k[2] + root * (k[3] + root * k[4])));
    return linear <= srgb::kLinearLimit ? linear * srgb::kLinearSlope : curve;
}

float linearFromDisplay(float display) {
    const auto& k = srgb::kFromDisplay;
    const float curve = k[0] + display * (k[1] + display * (k[2] + display * (k[3] + display * k[4])));
    return display <= srgb::kDisplayLimit ? display * (1 / srgb::kLinearSlope) : curve;
}

float toneMapped(const block::Frame& block, float light) {
    return std::min(block.isToneMapped != 0 ? light / (1 + light) : light, 1.0F);
}

void setLight(const plan::View& view, const plan::ShadingSettings& look, plan::Shading shading, block::Frame& block) {
    const auto ambient = static_cast<float>(look.ambient);
    block.isFaceted = shading == plan::Shading::Flat ? 1 : 0;
    block.isToneMapped = 1;
    block.skyAxis = glm::vec3(skyAxis(view));
    block.ambientMean = 0.5F * ambient * (kSky + kGround);
    block.ambientTilt = 0.5F * ambient * (kSky - kGround);
    block.headlight = ambient * kFill;
    block.sun = kSun;
    if (shading == plan::Shading::Headlight) {
        const CameraBasis basis = cameraBasis(view.camera);
        block.skyAxis = glm::vec3(glm::normalize(basis.up + kDimLean * basis.right));
        block.ambientMean = glm::vec3(ambient * kDim);
        block.ambientTilt = glm::vec3(ambient * kDimTilt);
        block.headlight = kHeadlight;
        block.sun = glm::vec3(0);
    }
    if (shading == plan::Shading::Unlit) {
        block.isToneMapped = 0;
        block.ambientMean = glm::vec3(1);
        block.ambientTilt = block.sun = glm::vec3(0);
        block.headlight = 0;
    }
}

void removeSkyLight(const plan::ShadingSettings& look, block::Frame& block) {
    const auto ambient = static_cast<float>(look.ambient);
    block.ambientMean = 0.5F * ambient * kGround;
    block.ambientTilt = -0.5F * ambient * kGround;
}

void keepOnlySkyDirection(const plan::ShadingSettings& look, double weight, block::Frame& block) {
    block.ambientMean = block.ambientTilt = glm::vec3(0);
    block.headlight = 0;
    block.sun = static_cast<float>(look.ambient * weight) * kSky;
}

} // namespace gnomon::render
