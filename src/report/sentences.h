// A summary of a set of runs in sentences that agree with its table.
#pragma once

#include "report/run_summary.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::report {

/// Returns up to three sentences about the runs: exact shadows compared with maps, if there are such runs; many maps
/// compared with few; and the sufficient number of maps. One side is called better or worse only if the difference in
/// time exceeds the noise. A ratio of times is given as a range.
std::vector<std::string> sentences(std::span<const RunSummary> runs);

} // namespace gnomon::report
