// The colours of overlays, chosen so that they stay apart for eyes without green cones and in a grey print.
#pragma once

#include <glm/glm.hpp>

#include <array>

namespace gnomon::executor {

/// Indices that differ by a multiple of this share a colour.
inline constexpr int kIndexColors = 8;

/// The colour of a factor, from a dark blue up to 1/4 over a neutral grey at 1 and orange at 4 to a pale yellow from
/// 16, even in its logarithm between these: the hue turns at 1, and lightness grows all the way, so that no factor
/// below 1 has the grey of one above.
glm::vec3 heatColor(float value);

/// A colour that is far from those of its neighbours, in lightness as well; `index` is at least 0.
glm::vec3 indexColor(int index);

/// What is painted, at half light and full light alternately, where no shadow map is looked up.
inline constexpr std::array kWithoutMap = {0.35F, 0.55F};

/// Why a cluster is drawn, as Residence has it: nothing finer is called for, it waits, or it cannot be read.
inline constexpr std::array kResidenceColors = {
    glm::vec3(0.35F, 0.55F, 0.75F), glm::vec3(1.0F, 0.85F, 0.3F), glm::vec3(0.55F, 0.05F, 0.1F)};

} // namespace gnomon::executor
