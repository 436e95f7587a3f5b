// The option --threads against what TBB then does.
#include "app/thread_limit.h"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <mutex>
#include <set>
#include <thread>

namespace gnomon::app {
namespace {

CommonOptions threads(int count) {
    CommonOptions options;
    options.threads = count;
    return options;
}

TEST(ThreadLimit, HoldsAsLongAsItLives) {
    const int before = ThreadLimit::current();
    {
        const ThreadLimit none(threads(0));
        EXPECT_EQ(ThreadLimit::current(), before);
        const ThreadLimit one(threads(1));
        EXPECT_EQ(ThreadLimit::current(), 1);
        std::mutex mutex;
        std::set<std::thread::id> workers;
        tbb::parallel_for(0, 1000, [&](int /*i*/) {
            const std::lock_guard lock(mutex);
            workers.insert(std::this_thread::get_id());
        });
        EXPECT_EQ(workers, std::set{std::this_thread::get_id()});
    }
    EXPECT_EQ(ThreadLimit::current(), before);
}

} // namespace
} // namespace gnomon::app
