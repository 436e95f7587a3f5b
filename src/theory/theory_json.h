// Figures and tables of the theory as JSON documents.
#pragma once

#include "theory/figures.h"
#include "theory/scheme_table.h"

#include <span>

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// Returns the description of a figure (labels, scales, panels) without its rows.
nlohmann::json describe(const Figure& figure);

/// Returns {"rows": [...]} with one element per entry of `table`.
nlohmann::json tableJson(std::span<const SchemeRow> table);

} // namespace gnomon::theory
