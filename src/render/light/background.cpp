#include "render/light/background.h"

#include "render/light/light_model.h"

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

// Colours of the sky background, in linear RGB.
constexpr glm::vec3 kZenith{0.26F, 0.42F, 0.66F};
constexpr glm::vec3 kHorizon{0.76F, 0.82F, 0.88F};
constexpr glm::vec3 kBelow{0.36F, 0.38F, 0.41F};
constexpr float kHaze = 0.2F; // sine of the elevation below the horizon at which the colour has faded to kBelow

/// Returns the smoothstep interpolation 3 x^2 - 2 x^3 for x in [0, 1].
float smooth(float x) {
    return x * x * (3 - 2 * x);
}

Rgb displayed(const glm::vec3& linear) {
    Rgb color{};
    for (std::size_t c = 0; c < color.size(); ++c)
        color[c] = static_cast<std::uint8_t>(std::lround(displayFromLinear(linear[static_cast<int>(c)]) * 255));
    return color;
}

} // namespace

Rgb skyColor(double sine) {
    const auto height = static_cast<float>(std::clamp(sine, -1.0, 1.0));
    if (height >= 0) return displayed(glm::mix(kHorizon, kZenith, std::sqrt(height)));
    return displayed(glm::mix(kHorizon, kBelow, smooth(std::min(-height / kHaze, 1.0F))));
}

std::optional<SkyRows> skyRows(const DrawInputs& frame) {
    const plan::View& view = frame.plan->view;
    if (frame.plan->quality.look.background.kind != plan::Background::Kind::Sky) return std::nullopt;
    const CameraBasis basis = cameraBasis(frame.observerCamera.value_or(view.camera));
    const glm::dvec3 up = glm::normalize(view.up);
    return SkyRows{
        static_cast<float>(glm::dot(basis.view, up)),
        static_cast<float>(glm::dot(basis.up, up)),
        static_cast<float>(view.tanHalfY())};
}

std::vector<Rgb> backgroundRows(const DrawInputs& frame) {
    const int height = frame.plan->view.height;
    std::vector<Rgb> rows(static_cast<std::size_t>(height), frame.plan->quality.look.background.color);
    const std::optional<SkyRows> sky = skyRows(frame);
    if (!sky) return rows;
    for (int y = 0; y < height; ++y) {
        const float above = (1 - (2 * static_cast<float>(y) + 1) / static_cast<float>(height)) * sky->tanHalfY;
        rows[static_cast<std::size_t>(y)] =
            skyColor((sky->middle + above * sky->perHeight) / std::sqrt(1 + above * above));
    }
    return rows;
}

bool isTransparent(const DrawInputs& frame) {
    return frame.plan->quality.look.background.kind == plan::Background::Kind::Transparent;
}

namespace {

/// Returns the ambient light that horizontal ground receives, from the parameters in `block`.
glm::vec3 ambientOf(const block::Frame& block, const glm::vec3& up) {
    return block.ambientMean + block.ambientTilt * glm::dot(up, block.skyAxis);
}

glm::vec3 sunOf(const DrawInputs& frame, const block::Frame& block, const glm::vec3& up) {
    return block.sun * std::max(glm::dot(up, glm::vec3(frame.plan->light.unit())), 0.0F);
}

} // namespace

glm::vec3 leftInShadow(const DrawInputs& frame) {
    if (frame.groundShade) return 1.0F - *frame.groundShade;
    block::Frame block{};
    setLight(frame.plan->view, frame.plan->quality.look, frame.shading, block);
    const glm::vec3 up(glm::normalize(frame.plan->view.up));
    const glm::vec3 sky = ambientOf(block, up);
    constexpr float kMinShare = 1.0F / (1 << 20);
    return glm::max(sky / (sky + sunOf(frame, block, up)), glm::vec3(kMinShare));
}

GroundShares groundShares(const DrawInputs& frame) {
    const plan::ShadingSettings& look = frame.plan->quality.look;
    block::Frame block{};
    setLight(frame.plan->view, look, frame.shading, block);
    const glm::vec3 up(glm::normalize(frame.plan->view.up));
    const glm::vec3 sun = sunOf(frame, block, up);
    removeSkyLight(look, block);
    const glm::vec3 rest = ambientOf(block, up);
    keepOnlySkyDirection(look, 1, block);
    const glm::vec3 all = glm::max(rest + block.sun + sun, glm::vec3(1e-6F));
    return {sun / all, block.sun / all};
}

std::vector<Rgb> shadowedRows(std::vector<Rgb> rows, const glm::vec3& left) {
    for (Rgb& row : rows)
        for (int c = 0; c < 3; ++c) {
            std::uint8_t& level = row[static_cast<std::size_t>(c)];
            const float light = linearFromDisplay(static_cast<float>(level) / 255) * left[c];
            level = static_cast<std::uint8_t>(std::lround(displayFromLinear(light) * 255));
        }
    return rows;
}

} // namespace gnomon::render
