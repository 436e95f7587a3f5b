// Checks rules that concern several pages: structure, nested bounding spheres and monotone errors.
#pragma once

#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Returns true if each refinement refers to an existing group in a finer page. All other checks require this.
bool refinementsResolve(const ModelFacts& model);

/// Checks each page, the references between pages, the values that the file stores twice, and the totals in the
/// summary.
Check checkStructure(const ModelFacts& model);

/// Checks that the bounding sphere of each group contains the group's box and the bounding spheres of all its
/// refinements. The worst value is the largest distance by which something extends beyond the sphere, in world units.
Check checkNesting(const ModelFacts& model);

/// Checks that stored errors never decrease towards the root and are at least the error of rounding to the grid. The
/// worst value is the largest decrease in world units.
Check checkMonotoneError(const ModelFacts& model);

} // namespace gnomon::verify
