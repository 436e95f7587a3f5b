// The table of all settings. The command line, the bench, the panel and the keys of the window, the report and the help
// all read it. The table does not contain --overlay and --oracle. These two options do not change the view or its
// quality, and only some commands have them.
#pragma once

#include "settings/setting.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::settings {

/// Returns all settings in the order in which the help shows them. Those that a bench sweeps are last.
std::span<const Setting> table();

/// Returns the setting with the given name, which must exist.
const Setting& named(std::string_view name);

/// Returns an option with its value as the user would type it, such as "--eta 0.5".
std::string optionText(const char* name, const Settings& settings);

/// Returns true if there is a setting with the given name.
bool isSetting(std::string_view name);

/// Returns the names of the options that set any of `limits`, separated by ", ". Returns an empty text if there is no
/// such option.
std::string optionsOf(std::span<const Limit> limits);

/// Returns true if `setting` has an effect on a frame with these `settings`. A setting of shadow maps has no effect
/// with exact shadows.
bool appliesTo(const Setting& setting, const Settings& settings);

/// Returns true if this option selects shadow maps when the shadow mode is Auto.
inline bool asksForMaps(const Setting& setting) {
    return setting.description().isOfMaps ||
           setting.name() == "cull-casters"; // allowed with exact shadows, without effect
}

/// Changes the shadow mode Auto to shadow maps. Called if the user requests an option, an overlay or a validation of
/// shadow maps.
inline void askForMaps(Settings& settings) {
    settings.quality.mapsBecause = plan::ShadowReason::MapsRequested;
}

/// Returns true if `a` and `b` have the same value for each setting that `gnomon bench` can sweep.
bool areAlike(const Settings& a, const Settings& b);

/// Returns true if `a` and `b` differ only in settings that change the speed but not the picture. The pictures of `a`
/// and `b` are then bit-identical.
bool drawAlike(const Settings& a, const Settings& b);

/// Returns the command-line options for all values of `settings` that differ from the default, quoted for a shell. If
/// `ofSwept` is true, they are the settings that a bench can sweep, otherwise all other settings.
std::string optionsToPaste(const Settings& settings, bool ofSwept);

/// Returns `text` quoted as one word for a POSIX shell.
std::string forShell(const std::string& text);

} // namespace gnomon::settings
