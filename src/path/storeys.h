// The storeys of a model: heights with a large area of floor below a ceiling.
#pragma once

#include "path/model_floor.h"

#include <string>

namespace gnomon::path {

/// A storey: the height of its floor and the walkable area below a ceiling, in world units.
struct Storey {
    double height = 0;
    double area = 0;
};

/// Returns the storeys of `floor` from below, at least a body height apart. They are the storey with the largest area,
/// and all storeys with 100 square metres (for a body of 1.7) or a quarter of the largest area.
std::vector<Storey> findStoreys(const WalkableFloor& floor);

/// Returns the range of heights of storey `index`: from two steps below to half a body above its floor, limited by the
/// next storey.
HeightBand bandOf(const std::vector<Storey>& storeys, std::size_t index, const WalkBody& body);

/// Returns a list for error messages, for example "0 (at 0.02), 1 (at 4.6)", or "none".
std::string listOf(const std::vector<Storey>& storeys);

} // namespace gnomon::path
