// How far closed forms are off, over the depth ratio: the table data/figures/ulps.csv.
#pragma once

#include "tests/theory/closed_forms.h"

#include <string>
#include <vector>

namespace gnomon::theory {

/// How far `found` is from `exact`, in units in the last place of that.
double ulpsOff(double found, const Real& exact);

/// The worst of `samples` draws of each closed form that begins with a view, by the power of ten of f/n - 1.
struct UlpsTable {
    int firstExponent = 0;
    std::vector<std::string> columns{};       // FORM: OUTPUT, without commas
    std::vector<std::vector<double>> worst{}; // by power of ten, then column; NaN where nothing was drawn
};

UlpsTable ulpsTable(int samples);

} // namespace gnomon::theory
