// Converts figures and tables of the shadow theory to JSON documents.
#pragma once

#include "theory/figures.h"
#include "theory/scheme_table.h"

#include <span>

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// Returns the presentation of a figure (labels, scales, panels) as JSON, without its rows.
nlohmann::json describe(const Figure& figure);

/// Returns the JSON document {"rows": [...]} with one element per entry of `table`.
nlohmann::json tableJson(std::span<const SchemeRow> table);

} // namespace gnomon::theory
