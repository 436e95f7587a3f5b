#include "hierarchy/world_frame.h"

#include <algorithm>
#include <cstdio>

namespace gnomon::hierarchy {

namespace {

struct AxisRow {
    std::string_view name;
    glm::dvec3 direction;
};

constexpr std::array<AxisRow, 6> kAxes = {
    {{"x", {1, 0, 0}}, {"y", {0, 1, 0}}, {"z", {0, 0, 1}}, {"-x", {-1, 0, 0}}, {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}}};

} // namespace

std::string upAxisText(const UpAxis& up) {
    for (const AxisRow& axis : kAxes)
        if (axis.direction == up.direction) return std::string(axis.name);
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(), "%.9g,%.9g,%.9g", up.direction.x, up.direction.y, up.direction.z);
    return text.data();
}

std::optional<UpAxis> upAxisNamed(std::string_view name) {
    const auto* const found = std::ranges::find(kAxes, name, &AxisRow::name);
    if (found == kAxes.end()) return {};
    return UpAxis{found->direction};
}

std::optional<Unit> unitNamed(std::string_view name) {
    const auto* const found = std::ranges::find(kUnits, name, &UnitRow::name);
    if (found == kUnits.end()) return {};
    return found->unit;
}

} // namespace gnomon::hierarchy
