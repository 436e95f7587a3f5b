#include "preprocess/distributed/task_pool.h"

#include "core/stopwatch.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <condition_variable>
#include <deque>
#include <mutex>

namespace gnomon::distributed {

struct TaskPool::State {
    explicit State(std::size_t threads)
        : limit(tbb::global_control::max_allowed_parallelism, threads + 1), arena(static_cast<int>(threads), 0) {
        arena.initialize();
    }

    tbb::global_control limit; // allows one more thread than `threads`: the thread that handles messages
    tbb::task_arena arena;     // its slots are for the pool threads, not for the thread that handles messages
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Finished> finished;
    std::size_t unfinished = 0;
};

TaskPool::TaskPool(std::size_t threads) : state_(std::make_unique<State>(threads)) {}

TaskPool::~TaskPool() {
    drain();
}

void TaskPool::drain() {
    std::unique_lock lock(state_->mutex);
    state_->changed.wait(lock, [&] { return state_->unfinished == 0; });
    state_->finished.clear();
    running_ = 0;
}

void TaskPool::start(std::uint32_t task, std::function<std::vector<std::byte>()> work) {
    ++running_;
    {
        const std::scoped_lock lock(state_->mutex);
        ++state_->unfinished;
    }
    state_->arena.enqueue([state = state_.get(), task, work = std::move(work)] {
        Finished finished;
        finished.task = task;
        const Stopwatch watch;
        try {
            finished.result = work();
        } catch (...) {
            finished.error = std::current_exception();
        }
        finished.seconds = watch.elapsed().count / 1000;
        const std::scoped_lock lock(state->mutex);
        state->finished.push_back(std::move(finished));
        --state->unfinished;
        state->changed.notify_all();
    });
}

std::optional<Finished> TaskPool::finished() {
    const std::scoped_lock lock(state_->mutex);
    if (state_->finished.empty()) return {};
    Finished first = std::move(state_->finished.front());
    state_->finished.pop_front();
    --running_;
    return first;
}

} // namespace gnomon::distributed
