// The axes of a bench: settings with the values that each takes, and all their combinations.
#pragma once

#include "settings/setting.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::settings {

/// A setting and the values that it takes, at least one.
struct Axis {
    const Setting* setting = nullptr;
    std::vector<Value> values;
};

/// The axis of `list`, values with commas between them, each once. Throws UsageError that names `option`.
Axis parseAxis(const Setting& setting, const std::string& option, const std::string& list);

/// `fixed` with every combination of the values of `axes`; the last axis varies fastest.
std::vector<Settings> combinations(const Settings& fixed, std::span<const Axis> axes);

} // namespace gnomon::settings
