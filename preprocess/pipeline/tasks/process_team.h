// The processes that build one model together, as the one that leads them sees them.
#pragma once

#include "core/progress.h"
#include "preprocess/pipeline/build_options.h"
#include "preprocess/pipeline/tasks/task_bytes.h"
#include "preprocess/pipeline/work_directory.h"

#include <string>

namespace gnomon::pipeline {

/// How the processes shared a phase.
struct TeamShare {
    double idle = 0;             // of the time of all their threads, the share in which these had no task; 0 to 1
    std::uint32_t slowest = 0;   // the process whose tasks took longest
    std::uint64_t tasks = 0;     // of all processes; 0: the leading one worked alone
    std::uint64_t bytesRead = 0; // of scratch files, by the others
    std::uint64_t bytesWritten = 0;
};

/// What one process did in a build.
struct ProcessReport {
    std::uint32_t rank = 0;
    std::string host;
    std::uint32_t threads = 0;
    std::uint64_t tasks = 0;
    double busySeconds = 0; // of all its tasks
    std::uint64_t peakResidentBytes = 0;
    std::uint64_t tableBytes = 0; // at most, of what is known of each vertex of the source
    std::uint64_t bytesSent = 0;  // in messages
    std::uint64_t bytesRead = 0;  // of scratch files
    std::uint64_t bytesWritten = 0;
};

/// Runs tasks once `begin` has told the others what they work on.
class ProcessTeam : public TaskRunner {
public:
    /// How many there are, the leading one included.
    virtual std::uint32_t processCount() const = 0;

    /// Waits until all are there with the same input and options; this process has `threads`. Throws Error.
    virtual void gather(const BuildOptions& options, std::size_t threads, Progress& progress) = 0;

    /// `place` is where this process's part of the scratch files is; each other has one of its own after it. What the
    /// others do advances `progress`, which must outlive all runs.
    virtual void begin(const ScratchPlace& place, Progress& progress) = 0;

    /// Tells all what tasks of chunks and nodes need.
    virtual void tell(const TaskFacts& facts) = 0;

    /// How what ran since the last call was shared.
    virtual TeamShare endPhase() = 0;
};

} // namespace gnomon::pipeline
