// Which options not every backend can carry out.
#pragma once

#include "settings/settings.h"

#include <optional>
#include <string>

namespace gnomon::settings {

/// An option that a backend cannot carry out.
struct BackendNeed {
    std::string option; // as it is written, with its value
    std::string reason; // completes the sentence "only the software executor ..."
};

/// The first option of `settings` that a backend with `capabilities` cannot carry out; nothing if it can do all.
std::optional<BackendNeed> unmetNeed(const Settings& settings, const plan::Capabilities& capabilities);

/// Whether only the software backend can carry out `settings`.
bool needsSoftware(const Settings& settings);

} // namespace gnomon::settings
