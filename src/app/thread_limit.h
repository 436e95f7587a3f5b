// Applies the option --threads during the lifetime of an object.
#pragma once

#include "app/commands.h"

#include <tbb/global_control.h>

#include <optional>

namespace gnomon::app {

/// Limits the worker threads of TBB to the number of `--threads` while the object exists. 0 means no limit. The limit
/// excludes threads that load pages, because they mostly wait.
class ThreadLimit {
public:
    explicit ThreadLimit(const CommonOptions& options);

    /// Returns the max number of threads that can work now, with or without a limit.
    static int current();

private:
    std::optional<tbb::global_control> control_;
};

} // namespace gnomon::app
