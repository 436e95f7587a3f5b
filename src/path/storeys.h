// Finds the storeys of a model. A storey is a height with a large area of floor below a ceiling.
#pragma once

#include "path/model_floor.h"

#include <string>

namespace gnomon::path {

/// A storey of a model: the height of its floor, and the walkable area below a ceiling, in world units.
struct Storey {
    double height = 0;
    double area = 0;
};

/// Returns the storeys of `floor`, sorted from below and at least a body height apart. They are the storey with the
/// largest area, and all storeys with at least 100 square metres (for an eye height of 1.7) or at least a quarter of
/// the largest area.
std::vector<Storey> findStoreys(const WalkableFloor& floor);

/// Returns the range of floor heights that belong to storey `index`. It reaches from two steps below its floor to half
/// a body height above it, and ends at the next storey.
HeightBand bandOf(const std::vector<Storey>& storeys, std::size_t index, const WalkBody& body);

/// Returns a text for error messages that lists the storeys and their heights: "0 (at 0.02), 1 (at 4.6)", or "none".
std::string listOf(const std::vector<Storey>& storeys);

} // namespace gnomon::path
