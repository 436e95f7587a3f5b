// The steps by which keys and buttons change a setting.
#pragma once

#include "settings/setting.h"

#include <string>

namespace gnomon::settings {

/// Takes `step` steps: words and offered numbers go round, a switch turns over, other numbers stay within what is
/// offered; a number goes by factors of sqrt(2), a size doubles or halves as a count. A step of 0 turns "auto" on or
/// off where there is one.
void step(const Setting& setting, Settings& settings, int steps);

/// The setting and its value for people: "slices: 4", "error pixels: 1.41".
std::string inWords(const Setting& setting, const Settings& settings);

} // namespace gnomon::settings
