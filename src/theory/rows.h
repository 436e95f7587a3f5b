// Evaluates the formulas of the shadow theory for rows of inputs, for `gnomon theory eval`. Each family of rows has
// one formula.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// Evaluates formulas for all rows of the JSON `document`, {"rows": [{"id", "family", "inputs"}]}, and returns {"rows":
/// [{"id", "got"}]}. The function ignores other fields of a row. `where` names the document in errors. Throws
/// gnomon::Error for a row without family or inputs, for an unknown family, or if an input is missing or not a number.
nlohmann::json evaluateRows(const nlohmann::json& document, const std::string& where);

} // namespace gnomon::theory
