#include "settings/path_options.h"

#include "core/formatted.h"
#include "settings/usage_error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace gnomon::settings {

void checkPathOptions(const PathOptions& options) {
    constexpr std::array<std::string_view, 5> kKinds{"walk", "orbit", "flyby", "approach", "source"};
    if (std::find(kKinds.begin(), kKinds.end(), options.kind) == kKinds.end())
        refuse("--kind", options.kind, "walk, orbit, flyby, approach or source");
    const auto& [storey, eyeHeight] = options.walk;
    if (storey && options.kind != "walk") throw UsageError{"--storey", "--storey needs --kind walk"};
    if (eyeHeight && options.kind != "walk") throw UsageError{"--eye-height", "--eye-height needs --kind walk"};
    if (storey && *storey < 0) refuse("--storey", std::to_string(*storey), "0 or more");
    if (eyeHeight && !(*eyeHeight > 0 && std::isfinite(*eyeHeight)))
        refuse("--eye-height", formatted("%g", *eyeHeight), "a height above 0");
}

} // namespace gnomon::settings
