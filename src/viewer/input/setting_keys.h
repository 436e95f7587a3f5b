// What the keys change of the settings.
#pragma once

#include "viewer/input/key_table.h"
#include "viewer/view_settings.h"

#include <optional>
#include <string>

namespace gnomon::viewer {

/// Shows or hides what `binding` is about; false if it is about something else.
bool changeShown(const Binding& binding, ViewSettings& settings);

/// Takes the step in quality that `binding` is, and returns what is now set, for people; nothing if it is about
/// something else.
std::optional<std::string> changeQuality(const Binding& binding, settings::Settings& settings);

} // namespace gnomon::viewer
