// A summary of a set of runs in sentences that agree with its table.
#pragma once

#include "report/run_summary.h"

#include <span>
#include <string>
#include <vector>

namespace gnomon::report {

/// Returns up to three sentences about the runs: exact shadows compared with maps, if there are such runs; many maps
/// compared with few; and the sufficient number of maps. Accuracy is the share of wrong pixels (see `wrongPixels`).
/// Each verdict is computed from the cited numbers. Two shares count as about equal if they differ by less than a tenth
/// of the larger, and two times if they differ by less than the cited noise. The last sentence is omitted if the
/// recommended run has more maps.
std::vector<std::string> sentences(std::span<const RunSummary> runs);

} // namespace gnomon::report
