// The up direction of a model's world, and the length of its unit.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::hierarchy {

/// The up direction of a model (away from the ground), as a unit vector in the coordinates of the source. The model
/// stores these coordinates unchanged.
struct UpAxis {
    glm::dvec3 direction{0, 1, 0};

    bool operator==(const UpAxis& other) const { return direction == other.direction; }
};

/// Returns the name of the up axis: x, y, z, -x, -y or -z. For other directions it returns the coordinates "X,Y,Z".
std::string upAxisText(const UpAxis& up);

/// Returns the up direction that `name` names (x, y, z, -x, -y or -z), or nullopt for other names.
std::optional<UpAxis> upAxisNamed(std::string_view name);

/// The unit of length of a model's coordinates. The enumerators have the numbers of the file format.
enum class Unit : std::uint8_t { Metre = 0, Centimetre = 1, Millimetre = 2, Foot = 3, Inch = 4 };

struct UnitRow {
    Unit unit;
    std::string_view name;
    double metres; // length of the unit in metres; exact by definition
};

constexpr std::array<UnitRow, 5> kUnits = {
    {{Unit::Metre, "m", 1},
     {Unit::Centimetre, "cm", 0.01},
     {Unit::Millimetre, "mm", 0.001},
     {Unit::Foot, "ft", 0.3048},
     {Unit::Inch, "in", 0.0254}}};

/// Returns the row of the table kUnits for `unit`, with its name and its length.
constexpr const UnitRow& rowOf(Unit unit) {
    return kUnits.at(static_cast<std::size_t>(unit));
}

/// Returns the unit with the name `name` in the table kUnits, or nullopt.
std::optional<Unit> unitNamed(std::string_view name);

} // namespace gnomon::hierarchy
