#include "settings/backend_needs.h"

#include "settings/table.h"

namespace gnomon::settings {

std::optional<BackendNeed> unmetNeed(const Settings& settings, const plan::Capabilities& capabilities) {
    const plan::Quality& quality = settings.quality;
    const auto need = [&](const char* name, const char* reason) {
        return BackendNeed{written(name, settings), reason};
    };
    if (quality.shadows == plan::ShadowMode::Exact && !capabilities.exactShadows)
        return need("shadows", "decides shadows exactly");
    if (shadow::rowsOf(quality.warp.rule) == shadow::RowSpacing::Logarithmic && !capabilities.unevenRows)
        return need("warp", "draws rows that lie unevenly");
    if (quality.cullCasters == plan::CasterCulling::Receivers && !capabilities.imageFirst)
        return need("cull-casters", "finds receivers before it draws maps");
    if (quality.occlusion == plan::Choice::On && !capabilities.occlusionCulling)
        return need("occlusion", "leaves out what is hidden");
    if (!settings.sections.empty() && !capabilities.sections) return BackendNeed{"--section", "draws sections"};
    if (quality.look.ground && !capabilities.ground) return need("ground", "shows the ground");
    return std::nullopt;
}

bool needsSoftware(const Settings& settings) {
    return unmetNeed(settings, plan::kOpenGlCapabilities).has_value();
}

} // namespace gnomon::settings
