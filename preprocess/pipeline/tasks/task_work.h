// How the tasks of a build are done, in whichever process.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/ranges/range_work.h"
#include "preprocess/pipeline/tasks/task_bytes.h"

namespace gnomon::pipeline {

/// Does tasks; safe from many threads. All must outlive it.
class TaskWork {
public:
    TaskWork(
        read::MeshSource& source,
        const levels::LevelOptions& options,
        scratch::ScratchFile& scratch,
        Progress& progress)
        : ranges_(source, scratch, progress), options_(options), scratch_(scratch), progress_(progress) {}

    /// Before tasks of chunks and nodes, while none runs.
    void tell(const TaskFacts& facts) { facts_ = facts; }

    /// The most bytes that tasks together held of what is known of each vertex of the source.
    std::uint64_t mostTableBytes() const { return ranges_.mostTableBytes(); }

    /// The result of a task. Its bulk is appended to the scratch file, and handed over.
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
