// The settings of what a picture looks like besides its shadows.
#pragma once

#include "settings/setting.h"

#include <vector>

namespace gnomon::settings {

/// Projection, shading, ambient light and background. No bench sweeps them.
std::vector<Setting> lookSettings();

/// "PX,PY,PZ,NX,NY,NZ", several with semicolons between.
Codec<std::vector<Section>> sections();

/// "sky", "transparent", "white", or a colour as "#rrggbb", which is sRGB.
Codec<plan::Background> background();

} // namespace gnomon::settings
