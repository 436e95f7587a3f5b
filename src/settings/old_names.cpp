#include "settings/old_names.h"

#include <array>

namespace gnomon::settings {

namespace {

struct Renamed {
    std::string_view before;
    std::string_view now;
};

constexpr std::array kRenamed = {
    Renamed{"ecef", "geodetic"},
    Renamed{"near", "shadow-near"},
    Renamed{"far", "shadow-far"},
    Renamed{"real-time", "no-wait"},
};

} // namespace

std::string_view currentName(std::string_view name) {
    for (const Renamed& each : kRenamed)
        if (each.before == name) return each.now;
    return name;
}

std::string withOldNames(const std::string& option) {
    std::string names = option;
    for (const Renamed& each : kRenamed)
        if (option.substr(2) == each.now) names.append(",--").append(each.before);
    return names;
}

} // namespace gnomon::settings
