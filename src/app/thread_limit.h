// Limits the number of worker threads, for the option --threads.
#pragma once

#include "app/commands.h"

#include <tbb/global_control.h>

#include <optional>

namespace gnomon::app {

/// Limits the worker threads of TBB to the number of `--threads` while the object exists. 0 means no limit. Threads
/// that load pages are not limited, because they mostly wait.
class ThreadLimit {
public:
    explicit ThreadLimit(const CommonOptions& options);

    /// Returns the max number of worker threads, with or without a limit.
    static int current();

private:
    std::optional<tbb::global_control> control_;
};

} // namespace gnomon::app
