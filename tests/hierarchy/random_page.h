// Pages at random that keep all rules and have everything at once.
#pragma once

#include "core/random.h"
#include "hierarchy/page.h"

namespace gnomon::hierarchy {

Sphere randomSphere(Random& random);

/// Any page that keeps the rules: triangles at random, doubled ones and ones of equal corners among them.
Page randomPage(std::uint64_t seed);

} // namespace gnomon::hierarchy
