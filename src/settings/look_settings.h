// The options that change the look of a picture, except its shadows.
#pragma once

#include "settings/setting.h"

#include <vector>

namespace gnomon::settings {

/// Returns the settings for projection, shading, ambient light, background, ground and sections. `gnomon bench` does
/// not accept lists of values for them.
std::vector<Setting> lookSettings();

/// Returns the text codec for a list of 1 to kMaxSections section planes, separated by semicolons. A plane is
/// "PX,PY,PZ,NX,NY,NZ": a point and a normal.
Codec<std::vector<Section>> sections();

/// Returns the text codec for a background. Its values are "sky", "transparent", "white", and an sRGB colour "#rrggbb".
Codec<plan::Background> background();

} // namespace gnomon::settings
