// The colours of overlays. They are distinguishable in a grey print and with deuteranopia (a form of colour
// blindness).
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace gnomon::render {

/// Number of different colours of `indexColor`. Indices that differ by a multiple of this number have the same colour.
inline constexpr int kIndexColors = 8;

/// Returns the colour of a factor: dark blue up to 1/4, neutral grey at 1, orange at 4 and pale yellow from 16. Between
/// these values, the colour is linear in the logarithm of the factor. The hue changes at 1. The lightness increases
/// with the factor, so factors below and above 1 also differ in a grey print.
glm::vec3 heatColor(float value);

/// Returns a colour for `index`, which is at least 0. Neighbouring indices have strongly different hues and
/// lightnesses.
glm::vec3 indexColor(int index);

/// The two brightness values of the stripes that mark surfaces without a shadow map.
inline constexpr std::array kWithoutMap = {0.35F, 0.55F};

/// The colours of clusters in the residency overlay: Final, Pending and Damaged.
inline constexpr std::array kResidenceColors = {
    glm::vec3(0.35F, 0.55F, 0.75F), glm::vec3(1.0F, 0.85F, 0.3F), glm::vec3(0.55F, 0.05F, 0.1F)};

} // namespace gnomon::render
