// Which way is up in a model's world, and how long its unit is.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::hierarchy {

/// The direction away from the ground in the source's own coordinates, which a model keeps as they are; unit length.
struct UpAxis {
    glm::dvec3 direction{0, 1, 0};

    bool operator==(const UpAxis& other) const { return direction == other.direction; }
};

/// How a word names an axis: x, y, z, -x, -y or -z, else the direction as X,Y,Z.
std::string upAxisText(const UpAxis& up);

/// The axis of one of the six words; nothing for any other.
std::optional<UpAxis> upAxisNamed(std::string_view name);

/// The length that a coordinate of 1 stands for. The numbers are those of the file.
enum class Unit : std::uint8_t { Metre = 0, Centimetre = 1, Millimetre = 2, Foot = 3, Inch = 4 };

struct UnitRow {
    Unit unit;
    std::string_view name;
    double metres; // exact by definition
};

constexpr std::array<UnitRow, 5> kUnits = {
    {{Unit::Metre, "m", 1},
     {Unit::Centimetre, "cm", 0.01},
     {Unit::Millimetre, "mm", 0.001},
     {Unit::Foot, "ft", 0.3048},
     {Unit::Inch, "in", 0.0254}}};

/// The name and the length of a unit of the file.
constexpr const UnitRow& rowOf(Unit unit) {
    return kUnits.at(static_cast<std::size_t>(unit));
}

/// The unit of a name of kUnits; nothing for any other.
std::optional<Unit> unitNamed(std::string_view name);

} // namespace gnomon::hierarchy
