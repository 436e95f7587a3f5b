// The tasks of this process, in threads beside the one that talks to the other processes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::distributed {

/// What came of a task: a result, or what it has thrown.
struct Finished {
    std::uint32_t task = 0;
    std::vector<std::byte> result;
    double seconds = 0;
    std::exception_ptr error;
};

class TaskPool {
public:
    /// Runs tasks in `threads` threads. TBB has no more threads in this process while this object exists, beside the
    /// thread that makes it.
    explicit TaskPool(std::size_t threads);

    /// Waits for the tasks that run.
    ~TaskPool();
    TaskPool(const TaskPool&) = delete;
    TaskPool& operator=(const TaskPool&) = delete;
    TaskPool(TaskPool&&) = delete;
    TaskPool& operator=(TaskPool&&) = delete;

    /// How many tasks were started whose outcome was not taken.
    std::size_t running() const { return running_; }

    /// Runs `work` soon.
    void start(std::uint32_t task, std::function<std::vector<std::byte>()> work);

    /// An outcome, if there is one.
    std::optional<Finished> finished();

    /// Waits for all that runs, and forgets what comes of it.
    void drain();

private:
    struct State;

    std::size_t running_ = 0;
    std::unique_ptr<State> state_;
};

} // namespace gnomon::distributed
