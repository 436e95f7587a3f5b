// Changes a setting by steps, for the keys and buttons of the window.
#pragma once

#include "settings/setting.h"

#include <string>

namespace gnomon::settings {

/// Changes `setting` by `steps` steps, by its kind:
/// - a word, or a whole number with a list of steps, moves along its list and wraps around;
/// - a switch is inverted;
/// - another whole number changes by 1 per step, within the offered range;
/// - a number changes by a factor of sqrt(2) per step, within the offered range;
/// - a size doubles one side (if `steps` is positive) or halves one side, within the offered range.
/// For a setting with "auto", 0 steps switch between "auto" and a number.
void step(const Setting& setting, Settings& settings, int steps);

/// Returns a short text with the title and the value of a setting, such as "slices: 4" or "error pixels: 1.41". Numbers
/// have three digits.
std::string inWords(const Setting& setting, const Settings& settings);

} // namespace gnomon::settings
