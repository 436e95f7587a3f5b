// How the tasks of a build are done, in whichever process.
#pragma once

#include "core/progress.h"
#include "preprocess/levels/level.h"
#include "preprocess/pipeline/tasks/task_bytes.h"

namespace gnomon::pipeline {

/// Does tasks; safe from many threads. All must outlive it.
class TaskWork {
public:
    TaskWork(
        const TaskFacts& facts, const levels::LevelOptions& options, scratch::ScratchFile& scratch, Progress& progress)
        : facts_(facts), options_(options), scratch_(scratch), progress_(progress) {}

    /// The result of a task. Its bulk is appended to the scratch file, and handed over.
    std::vector<std::byte> perform(TaskKind kind, std::span<const std::byte> input) const;

private:
    std::vector<std::byte> resultOf(TaskKind kind, hierarchy::ByteReader& in) const;
    std::vector<std::byte> answer(TaskKind kind, hierarchy::ByteReader& in) const;
    std::vector<std::byte> buildNode(hierarchy::ByteReader& in) const;
    std::vector<std::byte> routeClusters(hierarchy::ByteReader& in) const;
    std::vector<std::byte> shareLocks(hierarchy::ByteReader& in) const;
    std::vector<std::byte> writePages(hierarchy::ByteReader& in) const;

    TaskFacts facts_;
    levels::LevelOptions options_;
    scratch::ScratchFile& scratch_;
    Progress& progress_;
};

} // namespace gnomon::pipeline
