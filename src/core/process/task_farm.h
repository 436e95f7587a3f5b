// Independent tasks and who does them: this process alone, or all processes of a job (a task farm).
#pragma once

#include "core/progress.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

using TaskBytes = std::vector<std::byte>;

/// How tasks are done, in whichever process.
struct FarmWork {
    enum class Thread : std::uint8_t {
        Calling, // in the thread that asks; processes talk only while `progress` advances, which disturbs no timed step
        Another, // in a thread beside it, one task at a time, while the one that asks talks
    };

    /// Hands something of a task to the leading process before the task ends; of tasks in the calling thread alone.
    using Tell = std::function<void(TaskBytes)>;

    /// From a task's input to its result. What comes out hangs on nothing else.
    std::function<TaskBytes(std::span<const std::byte> input, Progress& progress, const Tell& tell)> perform;
    Thread thread = Thread::Calling;
};

/// Tasks that do not wait for each other, as the process that leads knows them.
struct FarmTasks {
    std::string name; // of them all, in the report
    std::size_t count = 0;
    std::function<TaskBytes(std::size_t task)> input;

    /// Gets each task's result, one at a time, in any order.
    std::function<void(std::size_t task, std::span<const std::byte> result)> take;

    /// Gets what tasks tell, if they tell anything; of one task in its order.
    std::function<void(std::span<const std::byte> told)> hear = {};
};

/// What a process says of itself.
struct FarmMember {
    std::uint32_t rank = 0;
    std::string host;
    std::string machine; // its processor
    std::uint32_t threads = 0;
    std::uint64_t tasks = 0;
    double busySeconds = 0; // of all its tasks
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t bytesSent = 0; // in messages
};

/// How the processes shared tasks of one name.
struct FarmPhase {
    std::string name;
    std::uint64_t tasks = 0;
    double idleShare = 0; // of the time of all processes, how much had no task; 0 to 1
    std::uint32_t slowestRank = 0;
};

/// Who did what.
struct FarmReport {
    std::vector<FarmMember> members;
    std::vector<FarmPhase> phases;
};

/// The processes that do tasks together. All run the same command; one leads.
class TaskFarm {
public:
    TaskFarm() = default;
    virtual ~TaskFarm() = default;
    TaskFarm(const TaskFarm&) = delete;
    TaskFarm& operator=(const TaskFarm&) = delete;
    TaskFarm(TaskFarm&&) = delete;
    TaskFarm& operator=(TaskFarm&&) = delete;

    /// Whether another process leads: then this one serves, writes nothing and says nothing.
    virtual bool isLed() const = 0;

    /// Waits until all are there; each says its threads and what processor it has. Throws Error if one works on
    /// something else, by its `key`.
    virtual void gather(const std::string& key, const FarmMember& self, Progress& progress) = 0;

    /// Of a process that is led: does tasks until there are none left. `progress` is polled for interruptions.
    virtual void serve(const FarmWork& work, Progress& progress) = 0;

    /// Of the leading process: has all tasks done, and does its share. `progress` advances by what all do. Throws what
    /// a task throws.
    virtual void run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) = 0;

    /// Who did what so far; nothing of a process alone.
    virtual FarmReport report() const = 0;
};

/// This process alone: tasks in their order, in the calling thread.
class LoneFarm final : public TaskFarm {
public:
    bool isLed() const override { return false; }

    void gather(const std::string& /*key*/, const FarmMember& /*self*/, Progress& /*progress*/) override {}

    void serve(const FarmWork& /*work*/, Progress& /*progress*/) override {}

    void run(const FarmTasks& tasks, const FarmWork& work, Progress& progress) override {
        const auto tell = [&](const TaskBytes& told) {
            if (tasks.hear) tasks.hear(told);
        };
        for (std::size_t task = 0; task < tasks.count; ++task)
            tasks.take(task, work.perform(tasks.input(task), progress, tell));
    }

    FarmReport report() const override { return {}; }
};

} // namespace gnomon
