// The effect of the option --threads during the lifetime of an object.
#pragma once

#include "app/commands.h"

#include <tbb/global_control.h>

#include <optional>

namespace gnomon::app {

/// A limit of the worker threads of TBB to `--threads`, while the object exists. 0 sets no limit. The threads that load
/// pages do not count, because they mostly wait.
class ThreadLimit {
public:
    explicit ThreadLimit(const CommonOptions& options);

    /// Returns the max number of threads that can work now, with or without a limit.
    static int current();

private:
    std::optional<tbb::global_control> control_;
};

} // namespace gnomon::app
