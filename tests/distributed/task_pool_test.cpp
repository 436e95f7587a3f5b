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

/// How many are at it together, at most.
class Together {
public:
    void enter() {
        const int together = ++now_;
        int before = max_;
        while (before < together && !max_.compare_exchange_weak(before, together)) {
        }
    }

    void leave() { --now_; }

    int max() const { return max_; }

private:
    std::atomic<int> now_{0};
    std::atomic<int> max_{0};
};

void expectAllOnce(TaskPool& pool, std::size_t tasks, int expectedToFail) {
    std::set<std::uint32_t> seen;
    int failed = 0;
    while (pool.running() > 0) {
        const std::optional<Finished> finished = pool.finished();
        if (!finished) continue;
        EXPECT_TRUE(seen.insert(finished->task).second);
        EXPECT_GE(finished->seconds, 0.001);
        EXPECT_EQ(finished->result.size(), finished->error ? 0 : finished->task);
        failed += finished->error ? 1 : 0;
    }
    EXPECT_EQ(seen.size(), tasks);
    EXPECT_EQ(failed, expectedToFail);
}

TEST(TaskPool, RunsAllAndHasNoMoreThreadsThanItSays) {
    for (const std::size_t threads : {1U, 3U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads + 1);
        TaskPool pool(threads);
        Together together;
        for (std::uint32_t task = 0; task < 40; ++task)
            pool.start(task, [&together, task] {
                together.enter();
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
                together.leave();
                if (task % 10 == 9) throw Error("the tenth");
                return std::vector<std::byte>(task);
            });
        EXPECT_EQ(pool.running(), 40U);
        expectAllOnce(pool, 40, 4);
        EXPECT_LE(together.max(), static_cast<int>(threads));
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
