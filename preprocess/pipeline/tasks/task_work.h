// Runs the tasks of a build. Each process of a distributed build can run them.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/ranges/range_work.h"
#include "preprocess/pipeline/tasks/task_bytes.h"

namespace gnomon::pipeline {

/// Runs build tasks. Many threads can call `perform` at once. All constructor arguments must outlive the object.
class TaskWork {
public:
    TaskWork(
        read::MeshSource& source,
        const levels::LevelOptions& options,
        scratch::ScratchFile& scratch,
        Progress& progress)
        : ranges_(source, scratch, progress), options_(options), scratch_(scratch), progress_(progress) {}

    /// Sets the grid and the vertex format that tasks of chunks and nodes use. No task may run during the call.
    void tell(const TaskFacts& facts) { facts_ = facts; }

    /// Returns the peak size in bytes of the per-vertex tables, summed over all tasks that ran at the same time.
    std::uint64_t maxTableBytes() const { return ranges_.maxTableBytes(); }

    /// Runs one build task and returns its result. Large results are appended to the scratch file, where other
    /// processes can read them.
    std::vector<std::byte> perform(TaskKind kind, std::span<const std::byte> input) const;

private:
    std::vector<std::byte> resultOf(TaskKind kind, hierarchy::ByteReader& in) const;
    std::vector<std::byte> answer(TaskKind kind, hierarchy::ByteReader& in) const;
    std::vector<std::byte> buildNode(hierarchy::ByteReader& in) const;
    std::vector<std::byte> routeClusters(hierarchy::ByteReader& in) const;
    std::vector<std::byte> shareLocks(hierarchy::ByteReader& in) const;
    std::vector<std::byte> writePages(hierarchy::ByteReader& in) const;

    RangeWork ranges_;
    TaskFacts facts_;
    levels::LevelOptions options_;
    scratch::ScratchFile& scratch_;
    Progress& progress_;
};

} // namespace gnomon::pipeline
