// Files that are embedded at build time: the script that draws the theory's figures (figures.py), and how far closed
// forms are off (data/figures/ulps.csv).
#pragma once

#include <string_view>

namespace gnomon::theory {

extern const std::string_view kFiguresScript;

/// Comma-separated: a header, then a line for each power of ten of f/n - 1, whose exponent is column 0; in each other
/// column, `FORM: OUTPUT`, the worst error in units in the last place, empty where nothing was drawn.
extern const std::string_view kUlpsTable;

} // namespace gnomon::theory
