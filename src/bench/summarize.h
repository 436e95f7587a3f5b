// The statistics of one run, for the report and for baselines.
#pragma once

#include "bench/bench_runs.h"
#include "report/run_summary.h"

namespace gnomon::bench {

/// Returns the statistics of a run: percentiles and noise of the frame times, median times of the stages, mean triangle
/// counts, and errors.
report::RunSummary summarize(const RunResult& result);

} // namespace gnomon::bench
