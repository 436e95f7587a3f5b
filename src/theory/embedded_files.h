// Files that are embedded at build time: the script figures.py, which draws the figures of the shadow theory, and
// data/figures/ulps.csv, the errors of its formulas.
#pragma once

#include <string_view>

namespace gnomon::theory {

extern const std::string_view kFiguresScript;

/// The errors of the formulas of the shadow theory as a CSV table with a header. Each line is for one power of ten of
/// f/n - 1, and column 0 is its exponent. Each other column, `FORM: OUTPUT`, contains the largest error in units in the
/// last place. A cell is empty if there was no random input for it.
extern const std::string_view kUlpsTable;

} // namespace gnomon::theory
