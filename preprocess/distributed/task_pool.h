// Runs the tasks of this process in a thread pool, while the main thread exchanges messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::distributed {

/// A finished task, with its result or the exception that it threw.
struct Finished {
    std::uint32_t task = 0;
    std::vector<std::byte> result;
    double seconds = 0;
    std::exception_ptr error;
};

/// A thread pool that runs build tasks.
class TaskPool {
public:
    /// Creates a pool of `threads` threads. While the pool exists, TBB uses only these threads and the thread that
    /// created the pool.
    explicit TaskPool(std::size_t threads);

    /// Waits until all running tasks have finished.
    ~TaskPool();
    TaskPool(const TaskPool&) = delete;
    TaskPool& operator=(const TaskPool&) = delete;
    TaskPool(TaskPool&&) = delete;
    TaskPool& operator=(TaskPool&&) = delete;

    /// Returns the number of tasks whose results are still pending or not yet fetched with `finished`.
    std::size_t running() const { return running_; }

    /// Starts `work` in a thread of the pool as the task with the number `task`. The task waits until a thread is free.
    void start(std::uint32_t task, std::function<std::vector<std::byte>()> work);

    /// Returns the next finished task, or nullopt if no task has finished.
    std::optional<Finished> finished();

    /// Waits until all started tasks have finished, and discards their results.
    void drain();

private:
    struct State;

    std::size_t running_ = 0;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::distributed
