// The keys of the context that must be equal in two benches, so that their results are comparable.
#pragma once

#include "bench/result_set.h"

namespace gnomon::bench {

/// Returns the keys that must be equal in the context of `before` and in `now`:
/// - model, camera path, number of frames, real-time mode, backend, number of threads;
/// - view, light and memory limits;
/// - the given options. A changed default is not an option, because gates for work and accuracy judge it.
/// Names of runs contain swept settings. If `allowsOtherModel` is true, the sources of the models must be equal instead
/// of the models. A file of an earlier form has other keys for the options.
std::vector<std::string> alikeKeys(
    const ResultSet& before, const std::map<std::string, std::string>& now, bool allowsOtherModel);

/// Throws UsageError if a setting in the context or in a run's name of `set` has a value that no longer exists.
void refuseRemovedWords(const ResultSet& set);

} // namespace gnomon::bench
