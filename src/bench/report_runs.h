// The default runs of a report, for a command that sweeps no setting. They help to choose a shadow algorithm.
#pragma once

#include "bench/bench_runs.h"

namespace gnomon::bench {

/// Returns runs that vary the settings `asked`, the run with one map first. Each run varies one setting, so that its
/// cost and its gain are visible:
/// - number of slices, with and without caster culling,
/// - level of detail, warp, texels, stabilisation and face partitions,
/// - exact shadows with each cell scheme, if the backend supports them.
/// A quick report has fewer values of each. No two runs are equal. If `asked` gives eta or the focus of a trapezoidal
/// map, no run changes the warp or stabilises the maps.
std::vector<BenchRun> reportRuns(const settings::Settings& asked, bool isQuick);

} // namespace gnomon::bench
