// The conversion of measured runs to a result set.
#pragma once

#include "bench/bench_walk.h"
#include "bench/result_set.h"

namespace gnomon::bench {

/// Returns the name of a run in files: model/path/scheme/size/error/backend. `context` contains the file names of the
/// model and of the path. A slash within a part becomes an underscore.
std::string fullName(const std::map<std::string, std::string>& context, const RunResult& result);

/// Returns the results of all runs. The counters are those of the first repetition. They are left out if `isRealTime`,
/// because they then depend on the time at which pages arrive.
ResultSet resultSet(
    const std::map<std::string, std::string>& context, const std::vector<RunResult>& results, bool isRealTime);

} // namespace gnomon::bench
