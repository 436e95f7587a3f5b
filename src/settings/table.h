// The table of all settings: command line, axes of a bench, panel and keys of the window, report and help read it.
// --overlay and --oracle are none: they change neither the view nor its quality but say what is painted over the
// picture and what it is held against, their words are those of executor and proof, which lie above, and not all
// commands have them.
#pragma once

#include "settings/setting.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::settings {

/// All settings, in the order of the help: first those that no bench sweeps.
std::span<const Setting> table();

/// The one of that name, which must be there.
const Setting& named(std::string_view name);

/// The option of a setting and its value, as they are written: "--eta 0.5".
std::string written(const char* name, const Settings& settings);

/// The options of the settings whose quantities `message` names, ", " between them; empty if it names none.
std::string optionsOf(std::string_view message);

/// Whether `setting` can be given beside the rest of `settings`: what is asked of maps cannot, beside exact shadows.
bool appliesTo(const Setting& setting, const Settings& settings);

/// Whether `setting`, where it is given, says that shadows whose mode is left open are maps.
inline bool asksForMaps(const Setting& setting) {
    return setting.description().isOfMaps || setting.name() == "cull-casters"; // which exact shadows leave as it is
}

/// Says that shadows whose mode is left open are maps, for an option, an overlay or a proof of maps is asked for.
inline void askForMaps(Settings& settings) {
    settings.quality.mapsBecause = plan::ShadowReason::MapsRequested;
}

/// Whether all settings that a bench sweeps have the same values in `a` and `b`.
bool areAlike(const Settings& a, const Settings& b);

/// Whether pictures of `a` and `b` are the same to the bit: no setting that changes the picture differs.
bool drawAlike(const Settings& a, const Settings& b);

/// The options that give all values of `settings` that are not the default, of those that a bench sweeps or of the
/// others, as a shell takes them.
std::string optionsToPaste(const Settings& settings, bool ofSwept);

/// `text` as a POSIX shell takes it for one word.
std::string forShell(const std::string& text);

} // namespace gnomon::settings
