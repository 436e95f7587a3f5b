// `gnomon theory eval`: rows of inputs in, the shadow theory's answers out, one function per family of rows.
#pragma once

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// The document {"rows": [{"id", "got"}]} for `document`, which holds {"rows": [{"id", "family", "inputs"}]}; other
/// fields of a row are not needed. `where` names the document in errors. Throws gnomon::Error for a row without family
/// or inputs, an unknown family, or an input that is missing or not a number.
nlohmann::json evaluateRows(const nlohmann::json& document, const std::string& where);

} // namespace gnomon::theory
