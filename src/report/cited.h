// Numbers as sentences cite them. A sentence is computed from its cited numbers, so that it cannot contradict them.
#pragma once

#include <string>

namespace gnomon::report {

/// Returns `value` as a decimal number with `digits` significant digits, without exponent and trailing zeros. Numbers
/// of more digits before the point keep all of these.
std::string cited(double value, int digits = 3);

/// Returns the number that `cited(value)` shows.
double citedValue(double value);

/// Returns `value` with at least three digits, and with as many as are necessary to show a number of at most `limit`.
/// `value` must be at most `limit`.
std::string citedBelow(double value, double limit);

/// Returns a share from 0 to 1 as "0.25%".
std::string citedPercent(double share);

} // namespace gnomon::report
