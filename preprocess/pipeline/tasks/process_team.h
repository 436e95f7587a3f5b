// The interface through which the leading process uses the other processes that build the same model.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"

#include <string>

namespace gnomon::pipeline {

/// The distribution of the work of one phase over the processes.
struct TeamShare {
    double idle = 0;             // share of the thread time of all processes without a task; 0 to 1
    std::uint32_t slowest = 0;   // the process with the longest total task time
    std::uint64_t tasks = 0;     // number of tasks of all processes; 0: the leader worked alone
    std::uint64_t bytesRead = 0; // bytes that the other processes read from scratch files
    std::uint64_t bytesWritten = 0;
};

/// The work that one process did for a build.
struct ProcessReport {
    std::uint32_t rank = 0;
    std::string host;
    std::uint32_t threads = 0;
    std::uint64_t tasks = 0;
    double busySeconds = 0; // total time of all its tasks
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // peak size of its per-vertex tables
    std::uint64_t bytesSent = 0;  // bytes of messages
    std::uint64_t bytesRead = 0;  // bytes read from scratch files
    std::uint64_t bytesWritten = 0;
};

/// A team of processes. It runs tasks after `begin`.
class ProcessTeam : public TaskRunner {
public:
    /// Returns the number of processes, including the leader.
    virtual std::uint32_t processCount() const = 0;

    /// Waits until all processes have reported the same input and options. `threads` is the number of threads of this
    /// process. Throws Error.
    virtual void gather(const BuildOptions& options, std::size_t threads, Progress& progress) = 0;

    /// Tells the other processes where the scratch files are. `place` contains the part of this process, and each other
    /// process uses one of the following parts. The work of other processes advances `progress`, which must outlive all
    /// runs.
    virtual void begin(const ScratchPlace& place, Progress& progress) = 0;

    /// Sends `facts` to all processes. Tasks of chunks and nodes need them.
    virtual void tell(const TaskFacts& facts) = 0;

    /// Returns the distribution of the work since the previous call.
    virtual TeamShare endPhase() = 0;
};

} // namespace gnomon::pipeline
