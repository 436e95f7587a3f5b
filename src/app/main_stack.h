// The stack of the main thread and of those that it starts.
#pragma once

#include <functional>

namespace gnomon::app {

/// Returns what `work` returns. Where the user's limit makes stacks smaller than 8 MiB (`ulimit -s`), `work` runs on a
/// thread with a stack of that size, and so do all threads that are started later.
int onLargeStack(const std::function<int()>& work);

} // namespace gnomon::app
