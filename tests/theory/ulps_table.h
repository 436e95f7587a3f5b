// The rounding errors of closed forms over the depth ratio: the table data/figures/ulps.csv.
#pragma once

#include "tests/theory/closed_forms.h"

#include <string>
#include <vector>

namespace gnomon::theory {

/// Returns the difference between `found` and `exact` in units in the last place of `exact`.
double ulpsOff(double found, const Real& exact);

/// The max errors of `samples` draws per closed form that begins with a view, by power of ten of f/n - 1.
struct UlpsTable {
    int firstExponent = 0;
    std::vector<std::string> columns{};       // FORM: OUTPUT, without commas
    std::vector<std::vector<double>> worst{}; // by power of ten, then by column; NaN without draws
};

UlpsTable ulpsTable(int samples);

} // namespace gnomon::theory
