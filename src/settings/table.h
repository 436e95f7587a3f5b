// The table of all settings. The command line, the axes of a bench, the panel and the keys of the window, the report
// and the help all read it. --overlay and --oracle are not in the table: they do not change the view or its quality,
// the layers render and validation define their values, and only some commands have them.
#pragma once

#include "settings/setting.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::settings {

/// Returns all settings in the order of the help. The settings that a bench sweeps are last.
std::span<const Setting> table();

/// Returns the setting with this name, which must exist.
const Setting& named(std::string_view name);

/// Returns the option of a setting with its value, as on a command line: "--eta 0.5".
std::string optionText(const char* name, const Settings& settings);

/// Returns true if a setting has this name.
bool isSetting(std::string_view name);

/// Returns the options that set `limits`, separated by ", ". Returns an empty text if no option sets them.
std::string optionsOf(std::span<const Limit> limits);

/// Returns false for a setting of shadow maps if `settings` request exact shadows; otherwise true.
bool appliesTo(const Setting& setting, const Settings& settings);

/// Returns true if `setting`, when it is given, changes the shadow mode Auto to shadow maps.
inline bool asksForMaps(const Setting& setting) {
    return setting.description().isOfMaps ||
           setting.name() == "cull-casters"; // allowed with exact shadows, without effect
}

/// Changes the shadow mode Auto to shadow maps, because an option, an overlay or a validation of shadow maps is
/// requested.
inline void askForMaps(Settings& settings) {
    settings.quality.mapsBecause = plan::ShadowReason::MapsRequested;
}

/// Returns true if all settings that a bench sweeps have the same values in `a` and `b`.
bool areAlike(const Settings& a, const Settings& b);

/// Returns true if `a` and `b` differ only in settings that do not change the picture. Their pictures are then
/// identical to the bit.
bool drawAlike(const Settings& a, const Settings& b);

/// Returns the options for all values of `settings` that differ from the default, quoted for a shell. `ofSwept` selects
/// the settings that a bench sweeps, or all others.
std::string optionsToPaste(const Settings& settings, bool ofSwept);

/// Returns `text` quoted as one word for a POSIX shell.
std::string forShell(const std::string& text);

} // namespace gnomon::settings
