#include "preprocess/distributed/task_pool.h"

#include "core/stopwatch.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>

namespace gnomon::distributed {

struct TaskPool::State {
    /// With room for `most` threads; TBB warns of one that is made while fewer are allowed.
    explicit State(std::size_t most) : arena(static_cast<int>(most), 0) {
        allow(most);
        arena.initialize();
    }

    /// Beside the thread that talks.
    void allow(std::size_t threads) {
        allowed = threads;
        auto next = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, threads + 1);
        limit = std::move(next);
    }

    std::unique_ptr<tbb::global_control> limit;
    std::size_t allowed = 0;
    tbb::task_arena arena; // without a place for the thread that talks
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Finished> finished;
    std::size_t unfinished = 0;
};

TaskPool::TaskPool(std::size_t threads)
    : threads_(threads),
      state_(std::make_unique<State>(std::max(threads, static_cast<std::size_t>(tbb::info::default_concurrency())))) {
    state_->allow(threads);
}

void TaskPool::borrow(std::size_t lent) {
    const auto most = static_cast<std::size_t>(state_->arena.max_concurrency());
    const std::size_t threads = std::max(threads_, std::min(threads_ + lent, most));
    if (threads != state_->allowed) state_->allow(threads);
}

std::size_t TaskPool::sharedThreads() const {
    return state_->allowed;
}

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
