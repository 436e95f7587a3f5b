// The statistics of one run, for the report and the baseline.
#pragma once

#include "measure/bench_runs.h"
#include "report/run_summary.h"

namespace gnomon::measure {

/// Returns the medians, percentiles, noise and largest errors of a run.
report::RunSummary summarize(const RunResult& result);

} // namespace gnomon::measure
