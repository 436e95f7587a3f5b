// The interface with which the leading process uses the other processes of a distributed build.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"

#include <string>

namespace gnomon::pipeline {

/// The distribution of the tasks of one phase over the processes of a distributed build.
struct TeamShare {
    double idle = 0;             // share of thread time without a task, over all processes; 0 to 1
    std::uint32_t slowest = 0;   // the process with the longest total task time
    std::uint64_t tasks = 0;     // number of tasks of all processes; 0: the leader worked alone
    std::uint64_t bytesRead = 0; // bytes that the other processes read from scratch files
    std::uint64_t bytesWritten = 0;
};

/// The work of one process of a distributed build.
struct ProcessReport {
    std::uint32_t rank = 0;
    std::string host;
    std::uint32_t threads = 0;
    std::uint64_t tasks = 0;
    double busySeconds = 0; // total time of all its tasks
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // peak size of its per-vertex tables
    std::uint64_t bytesSent = 0;  // bytes of the messages that it sent
    std::uint64_t bytesRead = 0;  // bytes read from scratch files
    std::uint64_t bytesWritten = 0;
};

/// A team of processes that builds one model. It runs tasks after `begin`.
class ProcessTeam : public TaskRunner {
public:
    /// Returns the number of processes in the team, including the leader.
    virtual std::uint32_t processCount() const = 0;

    /// Waits until all processes have reported the same input and the same options. `threads` is the number of threads
    /// of this process. Throws Error.
    virtual void gather(const BuildOptions& options, std::size_t threads, Progress& progress) = 0;

    /// Sends the location of the scratch files to all other processes. `place` contains the part (file number) of this
    /// process, and each other process uses one of the following parts. The work of other processes advances
    /// `progress`, which must outlive all runs.
    virtual void begin(const ScratchPlace& place, Progress& progress) = 0;

    /// Sends the grid and the other data in `facts` to all processes. The tasks that build chunks and nodes need these
    /// data.
    virtual void tell(const TaskFacts& facts) = 0;

    /// Returns the distribution of the tasks over the processes since the previous call.
    virtual TeamShare endPhase() = 0;
};

} // namespace gnomon::pipeline
