#include "render/overlay/overlay_colors.h"

#include <algorithm>
#include <cmath>

namespace gnomon::render {

namespace {

/// Colours for indexColor. Their lightness values are at least 10 apart, and the values of adjacent colours differ by
/// 20 or more.
constexpr std::array<glm::vec3, kIndexColors> kColors = {
    glm::vec3(0.74F, 0.57F, 0.29F),
    glm::vec3(0.49F, 0.12F, 0.1F),
    glm::vec3(0.75F, 0.9F, 0.47F),
    glm::vec3(0.2F, 0.38F, 0.53F),
    glm::vec3(0.96F, 0.99F, 0.93F),
    glm::vec3(0.26F, 0.03F, 0.35F),
    glm::vec3(0.21F, 0.8F, 0.76F),
    glm::vec3(0.09F, 0.54F, 0.46F)};

} // namespace

glm::vec3 heatColor(float value) {
    const float x = glm::clamp(std::log2(std::max(value, 1e-6F)) * 0.5F, -1.0F, 2.0F);
    const glm::vec3 kept =
        glm::mix(glm::vec3(0.03F, 0.09F, 0.36F), glm::vec3(0.37F, 0.4F, 0.44F), glm::clamp(x + 1, 0.0F, 1.0F));
    const glm::vec3 above = glm::mix(kept, glm::vec3(0.86F, 0.57F, 0.18F), glm::clamp(x, 0.0F, 1.0F));
    return glm::mix(above, glm::vec3(1, 0.99F, 0.86F), glm::clamp(x - 1, 0.0F, 1.0F));
}

glm::vec3 indexColor(int index) {
    return kColors[static_cast<std::size_t>(index % kIndexColors)];
}

} // namespace gnomon::render
