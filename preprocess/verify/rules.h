// The rules between pages: structure, nested bounds and monotone errors.
#pragma once

#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Returns true if each refinement names an existing group of a finer page. All other checks need this.
bool refinementsResolve(const ModelFacts& model);

/// Checks each page, the references between pages, copied values, and the sums of the summary.
Check checkStructure(const ModelFacts& model);

/// Checks that the bounds of each group contain its box and the bounds of all its refinements. The worst value is the
/// largest excess in world units.
Check checkNesting(const ModelFacts& model);

/// Checks that errors never decrease towards the root and are at least the snap error of the grid. The worst value is
/// the largest decrease in world units.
Check checkMonotoneError(const ModelFacts& model);

} // namespace gnomon::verify
