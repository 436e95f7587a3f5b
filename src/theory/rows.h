// `gnomon theory eval`: evaluates the functions of the shadow theory for rows of inputs. Each family of rows has one
// function.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// Returns the document {"rows": [{"id", "got"}]} for `document`, which contains {"rows": [{"id", "family",
/// "inputs"}]}. The function ignores other fields of a row. `where` names the document in errors. Throws gnomon::Error
/// for a row without family or inputs, for an unknown family, or if an input is missing or not a number.
nlohmann::json evaluateRows(const nlohmann::json& document, const std::string& where);

} // namespace gnomon::theory
