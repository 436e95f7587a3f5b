// The rules that hold between pages: structure, nested bounds, monotone errors.
#pragma once

#include "preprocess/verify/model_facts.h"

namespace gnomon::verify {

/// Whether every refinement names a group of a finer page that is there: without that nothing else can be checked.
bool refinementsResolve(const ModelFacts& model);

/// Pages by themselves, references between them, copies that agree, sums that agree with the summary.
Check checkStructure(const ModelFacts& model);

/// Bounds of a group enclose its box and the bounds of all that its clusters refine to. Worst: how far something
/// sticks out, world units.
Check checkNesting(const ModelFacts& model);

/// Errors never decrease towards the root and none is below the grid's own. Worst: the largest decrease, world units.
Check checkMonotoneError(const ModelFacts& model);

} // namespace gnomon::verify
