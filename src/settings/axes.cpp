#include "settings/axes.h"

#include <set>

namespace gnomon::settings {

Axis parseAxis(const Setting& setting, const std::string& option, const std::string& list) {
    Axis axis{&setting, {}};
    std::set<std::string> known;
    for (const std::string& item : listItems(option, list)) {
        axis.values.push_back(setting.parse(option, item));
        if (!known.insert(setting.text(axis.values.back())).second) refuse(option, list, "each value once");
    }
    return axis;
}

std::vector<Settings> combinations(const Settings& fixed, std::span<const Axis> axes) {
    std::vector<Settings> all = {fixed};
    for (const Axis& axis : axes) {
        std::vector<Settings> extended;
        for (const Settings& settings : all)
            for (const Value& value : axis.values) {
                extended.push_back(settings);
                axis.setting->set(extended.back(), value);
            }
        all = std::move(extended);
    }
    return all;
}

} // namespace gnomon::settings
