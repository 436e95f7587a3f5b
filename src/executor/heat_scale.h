// The scale of the heat maps, drawn into a picture.
#pragma once

#include "executor/picture.h"

namespace gnomon::executor {

/// Draws the colours of the factors from 1/4 to 16, with their figures, into the lower left corner. Pictures too small
/// for it stay as they are.
void drawHeatScale(Picture& picture);

} // namespace gnomon::executor
