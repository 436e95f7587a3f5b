// The option --threads, as long as something holds it.
#pragma once

#include "app/commands.h"

#include <tbb/global_control.h>

#include <optional>

namespace gnomon::app {

/// While it lives, no more than `--threads` threads work at once; 0 sets no limit. Loaders of pages wait more than they
/// work and come on top.
class ThreadLimit {
public:
    explicit ThreadLimit(const CommonOptions& options);

    /// How many may work now, with or without a limit.
    static int current();

private:
    std::optional<tbb::global_control> control_;
};

} // namespace gnomon::app
