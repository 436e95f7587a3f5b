// The storeys of a model: heights at which there is much floor under a ceiling.
#pragma once

#include "path/model_floor.h"

#include <string>

namespace gnomon::path {

/// A storey: its floor's height and how much of it can be walked under a ceiling; world units.
struct Storey {
    double height = 0;
    double area = 0;
};

/// The storeys of `floor`, from below, no two nearer to each other than a body is high; that with the most floor, and
/// all others of 100 square metres (of a body of 1.7) or a quarter of the largest.
std::vector<Storey> findStoreys(const WalkableFloor& floor);

/// Which heights count as those of storey `index`: down by two steps and up by half a body, as far as the next one.
HeightBand bandOf(const std::vector<Storey>& storeys, std::size_t index, const WalkBody& body);

/// "0 (at 0.02), 1 (at 4.6)" for an error; "none" where there are none.
std::string listOf(const std::vector<Storey>& storeys);

} // namespace gnomon::path
