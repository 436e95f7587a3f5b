// The colours of values along a line.
#pragma once

#include "plan/color_map.h"

#include <glm/glm.hpp>

namespace gnomon::executor {

/// The colour of `part`, from 0, the least value, to 1, the greatest; what lies outside has the end's colour, and what
/// is no number the first. Viridis (Smith and van der Walt 2015) and cividis (Nuñez, Anderton and Renslow 2018) by ten
/// of their colours and straight lines between, less than two levels of 255 off; grey from 15% of full scale to 95%.
glm::vec3 mapColor(plan::ColorMap map, float part);

} // namespace gnomon::executor
