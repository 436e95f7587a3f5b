// Checks the stored errors of a model. It samples the distances between uniform cuts of the model and the source mesh,
// in both directions.
#pragma once

#include "preprocess/verify/check.h"
#include "preprocess/verify/loaded_model.h"
#include "preprocess/verify/triangle_tree.h"

namespace gnomon::verify {

/// Checks the stored errors of uniform cuts from the finest to the coarsest cut. The function samples points of the cut
/// and of `source` (corners, and random points by area) and measures their distances to the other surface.
/// - The distance of a cut point from the source must not exceed the stored error of its cluster.
/// - The distance of a source point from the cut must not exceed a bound. The triangle of level 0 that is nearest to
///   the point determines a group of level 0. The bound is the distance to this triangle plus the max stored error of
///   the coarser groups that replace this group.
/// - Corners of level 0 below densely sampled groups are also measured, but only for the tightness.
/// The worst value of the result is the max ratio of a sampled distance to its bound. It is at most 1 if all tests
/// pass. The tightness is the median, over densely sampled groups, of stored error / largest sampled distance. The
/// samples of the source depend only on the seed, so that the cuts of different models of one source are comparable.
Check checkErrorBound(const LoadedModel& model, const TriangleSoup& source, std::uint64_t seed, Progress& progress);

} // namespace gnomon::verify
