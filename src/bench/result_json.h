// The JSON file of a bench, in the form of Google Benchmark, and its reader.
#pragma once

#include "bench/result_set.h"

namespace gnomon::bench {

/// Returns the JSON text of `set`: the context, and per run one entry per repetition. Several repetitions have the
/// aggregates mean, median, stddev and cv too. `real_time` and `cpu_time` are means per frame in milliseconds. The
/// counters, errors and other figures are user counters. `frame_ms` and `frame_cpu_ms` contain the times of all frames.
std::string resultJson(const ResultSet& set);

/// Reads a file that `resultJson` made, or a file of the earlier form, which has one entry per run with its median
/// `p50`. Throws Error with the path and the position in the file if the file is not the result of a bench.
ResultSet readResultSet(const std::string& path);

} // namespace gnomon::bench
