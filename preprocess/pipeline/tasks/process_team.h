// The interface of the leading process to the processes that build one model together.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"

#include <string>

namespace gnomon::pipeline {

/// The distribution of a phase over the processes.
struct TeamShare {
    double idle = 0;             // idle share of the time of all threads; 0 to 1
    std::uint32_t slowest = 0;   // the process with the longest task time
    std::uint64_t tasks = 0;     // tasks of all processes; 0: the leader worked alone
    std::uint64_t bytesRead = 0; // bytes of scratch files read by the other processes
    std::uint64_t bytesWritten = 0;
};

/// The work of one process in a build.
struct ProcessReport {
    std::uint32_t rank = 0;
    std::string host;
    std::uint32_t threads = 0;
    std::uint64_t tasks = 0;
    double busySeconds = 0; // time of all its tasks
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // peak size of its per-vertex tables
    std::uint64_t bytesSent = 0;  // bytes of messages
    std::uint64_t bytesRead = 0;  // bytes of scratch files
    std::uint64_t bytesWritten = 0;
};

/// A team of processes that runs tasks after `begin`.
class ProcessTeam : public TaskRunner {
public:
    /// Returns the number of processes, including the leader.
    virtual std::uint32_t processCount() const = 0;

    /// Waits until all processes are ready with the same input and options. This process has `threads` threads. Throws
    /// Error.
    virtual void gather(const BuildOptions& options, std::size_t threads, Progress& progress) = 0;

    /// Starts the work. `place` is this process's part of the scratch files. Each other process uses one of the
    /// following parts. The work of other processes advances `progress`, which must outlive all runs.
    virtual void begin(const ScratchPlace& place, Progress& progress) = 0;

    /// Sends the facts that tasks of chunks and nodes need to all processes.
    virtual void tell(const TaskFacts& facts) = 0;

    /// Returns the distribution of the work since the last call.
    virtual TeamShare endPhase() = 0;
};

} // namespace gnomon::pipeline
