// A min stack size of 8 MiB for the main thread and all threads that it starts.
#pragma once

#include <functional>

namespace gnomon::app {

/// Runs `work` and returns its result. If the user's limit for stacks (`ulimit -s`) is below 8 MiB, `work` runs on a
/// thread with a stack of 8 MiB. All threads that are started later then have stacks of this size too.
int onLargeStack(const std::function<int()>& work);

} // namespace gnomon::app
