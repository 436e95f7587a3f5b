// What a person would say of a set of runs, in words that its table cannot refute.
#pragma once

#include "report/run_summary.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::report {

/// Up to three sentences, computed from the runs: exact shadows beside maps, if there are such runs; many maps beside
/// few; how many are enough. Each calls one side better or worse only where the noise of the times lets tell, and gives
/// a ratio of times as the range that the noise leaves.
std::vector<std::string> sentences(std::span<const RunSummary> runs);

} // namespace gnomon::report
