// The error rule with 200 bits, for a view and casters that are taken as exact.
#pragma once

#include "lod/error_rule.h"
#include "tests/support/real.h"

namespace gnomon::tests {

/// Returns the same value as ErrorRule::pixels.
theory::Real exactPixels(const lod::ErrorRule& rule, const Sphere& bounds, double error);

} // namespace gnomon::tests
