// The settings for the look of a picture, except its shadows.
#pragma once

#include "settings/setting.h"

#include <vector>

namespace gnomon::settings {

/// Returns the settings for projection, shading, ambient light, background, ground and sections. A bench does not sweep
/// them.
std::vector<Setting> lookSettings();

/// Returns the codec for 1 to kMaxSections planes "PX,PY,PZ,NX,NY,NZ" (a point and a normal), separated by semicolons.
Codec<std::vector<Section>> sections();

/// Returns the codec for a background: "sky", "transparent", "white", or an sRGB colour "#rrggbb".
Codec<plan::Background> background();

} // namespace gnomon::settings
