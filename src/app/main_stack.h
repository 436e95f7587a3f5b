// Ensures a stack of at least 8 MiB for the main thread and all threads that it starts.
#pragma once

#include <functional>

namespace gnomon::app {

/// Runs `work` on a stack of at least 8 MiB and returns its result. If the user's limit for stacks (`ulimit -s`) is
/// lower, `work` runs on a new thread. All threads that are started later then have stacks of 8 MiB too.
int onLargeStack(const std::function<int()>& work);

} // namespace gnomon::app
