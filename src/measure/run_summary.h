// The figures of a run, as a report and a baseline take them.
#pragma once

#include "measure/bench_runs.h"
#include "report/run_summary.h"

namespace gnomon::measure {

/// Medians, percentiles, noise and worst promises of a run.
report::RunSummary summary(const RunResult& result);

} // namespace gnomon::measure
