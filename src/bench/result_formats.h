// The results of a bench for other tools: a summary in Markdown, Bencher's metric format, github-action-benchmark.
#pragma once

#include "bench/gates.h"

namespace gnomon::bench {

/// Returns a table in Markdown with one row per run, and the gates of `verdict` if there is one.
std::string summaryMarkdown(const ResultSet& set, const Verdict* verdict);

/// Returns the results in Bencher's metric format (BMF): per run the measures `latency` (ns per frame, median with the
/// range of the repetitions), `cpu-latency` and each counter and error.
std::string bmfJson(const ResultSet& set);

/// Returns the results as the custom JSON of github-action-benchmark ("customSmallerIsBetter"): a list of objects with
/// `name`, `unit`, `value`, `range` and `extra`.
std::string actionJson(const ResultSet& set);

} // namespace gnomon::bench
