// Random valid pages that contain all features at once.
#pragma once

#include "core/random.h"
#include "hierarchy/page.h"

namespace gnomon::hierarchy {

Sphere randomSphere(Random& random);

/// Returns a random valid page, including duplicate triangles and triangles with equal corners.
Page randomPage(std::uint64_t seed);

} // namespace gnomon::hierarchy
