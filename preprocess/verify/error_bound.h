// Stored errors against the source: distances sampled both ways between whole uniform cuts and what they stand for.
#pragma once

#include "preprocess/verify/check.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

namespace gnomon::verify {

/// For uniform cuts at errors from the finest to the coarsest, samples points of the cut and of `source` (corners, and
/// points at random by area) and measures their distance to the other surface.
///  - A point of the cut must not be further from the source than the stored error of its cluster.
///  - A point of the source must not be further from the cut than the stored errors of the coarser groups that stand
///    for the level-0 group it belongs to (that of the nearest level-0 triangle, whose distance is added).
///  - For the tightness alone, corners of the finest level below densely sampled groups are measured to the cut, too.
/// Worst: the largest sampled distance as a share of its bound; at most 1 if all holds. Tightness: the median, over
/// groups of each cut sampled densely, of stored error / largest sampled distance. The points of the source are the
/// same for the same seed whatever the model, so that `cuts` of models of one source can be compared.
Check checkErrorBound(const LoadedModel& model, const TriangleSoup& source, std::uint64_t seed, Progress& progress);

} // namespace gnomon::verify
