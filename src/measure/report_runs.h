// The runs of a report whose command sweeps nothing itself: what a person would compare who chooses a shadow algorithm.
#pragma once

#include "measure/bench_runs.h"

namespace gnomon::measure {

/// Runs around `asked`, one map first: numbers of maps with casters culled per partition and not, levels of detail,
/// warps, texels, stabilisation and faces, each varied alone so that its own cost and gain are seen, and exact shadows
/// over each scheme of cells where the executor decides them. A quick look takes a few of each. None repeats another.
/// Where eta or the focus of a trapezoidal map settles the warp, no run has another one or is stabilised.
std::vector<BenchRun> reportRuns(const settings::Settings& asked, bool isQuick);

} // namespace gnomon::measure
