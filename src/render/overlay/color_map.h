// Colour maps for scalar values.
#pragma once

#include "plan/color_map.h"

#include <glm/glm.hpp>

namespace gnomon::render {

/// Returns the colour of the colour map `map` at `part`, from 0 (min) to 1 (max). Values outside this range are
/// clamped, and NaN has the first colour. Viridis (Smith and van der Walt 2015) and cividis (Nuñez, Anderton and
/// Renslow 2018) are interpolated between ten of their colours, with an error of less than two levels of 255. Grey
/// ranges from 15% to 95% of full scale.
glm::vec3 mapColor(plan::ColorMap map, float part);

} // namespace gnomon::render
