// The error rule once more, at 200 bits, of a view and casters that are taken as exact.
#pragma once

#include "selection/error_rule.h"
#include "tests/theory/real.h"

namespace gnomon::tests {

/// As ErrorRule::pixels.
theory::Real exactPixels(const selection::ErrorRule& rule, const Sphere& bounds, double error);

} // namespace gnomon::tests
