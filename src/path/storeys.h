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

/// Returns the storeys of `floor` from below, at least a body height apart. The result contains the storey with the
/// largest area. It also contains each storey with at least 100 square metres (for an eye height of 1.7), or with at
/// least a quarter of the largest area.
std::vector<Storey> findStoreys(const WalkableFloor& floor);

/// Returns the height range of storey `index`: from two steps below its floor to half a body height above it, limited
/// by the next storey.
HeightBand bandOf(const std::vector<Storey>& storeys, std::size_t index, const WalkBody& body);

/// Returns a list for error messages, for example "0 (at 0.02), 1 (at 4.6)", or "none".
std::string listOf(const std::vector<Storey>& storeys);

} // namespace gnomon::path
