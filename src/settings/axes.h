// The settings for which `gnomon bench` accepts a list of values. A setting with its list is an axis. A bench runs all
// combinations of the values.
#pragma once

#include "settings/setting.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::settings {

/// A setting that a bench sweeps, and its values, at least one.
struct Axis {
    const Setting* setting = nullptr;
    std::vector<Value> values;
};

/// Parses the comma-separated values of `setting` in `list`. Throws UsageError that names `option` if a value is
/// invalid or occurs twice.
Axis parseAxis(const Setting& setting, const std::string& option, const std::string& list);

/// Returns all combinations of the values of `axes`. All other settings are those of `fixed`. The value of the last
/// axis varies fastest.
std::vector<Settings> combinations(const Settings& fixed, std::span<const Axis> axes);

} // namespace gnomon::settings
