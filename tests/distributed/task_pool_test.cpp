// Tasks in threads of their own, beside the one that starts them.
#include "core/error.h"
#include "preprocess/distributed/task_pool.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
#include <set>
#include <thread>

namespace gnomon::distributed {
namespace {

TEST(TaskPool, RunsAllAndHasNoMoreThreadsThanItSays) {
    for (const std::size_t threads : {1U, 3U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads + 1);
        TaskPool pool(threads);
        std::atomic<int> now{0};
        std::atomic<int> most{0};
        for (std::uint32_t task = 0; task < 40; ++task)
            pool.start(task, [&, task] {
                const int together = ++now;
                int before = most;
                while (before < together && !most.compare_exchange_weak(before, together)) {
                }
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                --now;
                if (task % 10 == 9) throw Error("the tenth");
                return std::vector<std::byte>(task);
            });
        EXPECT_EQ(pool.running(), 40U);
        std::set<std::uint32_t> seen;
        int failed = 0;
        while (pool.running() > 0) {
            const std::optional<Finished> finished = pool.finished();
            if (!finished) continue;
            EXPECT_TRUE(seen.insert(finished->task).second);
            EXPECT_GE(finished->seconds, 0.001);
            failed += finished->error ? 1 : 0;
            if (!finished->error) {
                EXPECT_EQ(finished->result.size(), finished->task);
            }
        }
        EXPECT_EQ(seen.size(), 40U);
        EXPECT_EQ(failed, 4);
        EXPECT_LE(most, static_cast<int>(threads));
        EXPECT_GE(most, 1);
    }
}

TEST(TaskPool, DrainsWhatRuns) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 3);
    std::atomic<int> done{0};
    {
        TaskPool pool(2);
        for (std::uint32_t task = 0; task < 20; ++task)
            pool.start(task, [&done] {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                ++done;
                return std::vector<std::byte>();
            });
        pool.drain();
        EXPECT_EQ(done, 20);
        EXPECT_EQ(pool.running(), 0U);
        EXPECT_FALSE(pool.finished());
        pool.start(0, [&done] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            ++done;
            return std::vector<std::byte>();
        });
    }
    EXPECT_EQ(done, 21) << "its end waits, too";
}

} // namespace
} // namespace gnomon::distributed
