// Figures and tables of the theory as JSON documents.
#pragma once

#include "theory/figures.h"
#include "theory/scheme_table.h"

#include <span>

#include <nlohmann/json.hpp>

namespace gnomon::theory {

/// How a figure is meant to be seen, without its rows.
nlohmann::json describe(const Figure& figure);

/// {"rows": [...]}, one an entry of `table`.
nlohmann::json tableJson(std::span<const SchemeRow> table);

} // namespace gnomon::theory
