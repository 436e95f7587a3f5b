// Golden rows computed with 200 bits and correctly rounded.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// Returns the expected values of `row`, each as the nearest double, and "inf" for infinity.
nlohmann::json exactRow(const nlohmann::json& row);

} // namespace gnomon::theory
