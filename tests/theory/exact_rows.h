// Golden rows answered at 200 bits and correctly rounded.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// What `row` of the golden rows expects, each number the double nearest to it, "inf" for infinity.
nlohmann::json exactRow(const nlohmann::json& row);

} // namespace gnomon::theory
