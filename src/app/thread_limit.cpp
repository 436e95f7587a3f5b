#include "app/thread_limit.h"

namespace gnomon::app {

ThreadLimit::ThreadLimit(const CommonOptions& options) {
    if (options.threads > 0)
        control_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.threads));
}

int ThreadLimit::current() {
    return static_cast<int>(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

} // namespace gnomon::app
