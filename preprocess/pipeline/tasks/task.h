// The pieces of a build that any process can do: each a pure function of its input and of what lies in scratch files.
#pragma once

#include "hierarchy/bytes.h"
#include "preprocess/scratch/stream_store.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::pipeline {

enum class TaskKind : std::uint8_t {
    CountFaces,      // of a range of the source: corners at each vertex, and a sample of edges
    MeasureVertices, // of a range: what corners there are in all, and within which box
    CountCells,      // of the octree, of a range of vertices
    BinVertices,     // of a range, to their chunks
    BinFaces,        // likewise
    AnswerVertices,  // of a chunk, for the others
    AnswerNormals,   // likewise
    BuildNode,       // from a chunk, or from clusters in a later round
    RouteClusters,   // of a node, to those of the next round
    ShareLocks,      // of the positions that several nodes of the next round use, those of one stream
    WritePages,      // that lie next to each other in the model, to their place there
};

/// Tasks that do not wait for each other.
struct TaskPhase {
    TaskKind kind = TaskKind::BuildNode;
    std::vector<std::uint32_t> tasks;                           // their numbers, ascending
    std::size_t atOnce = 1;                                     // at most, in one process: its memory allows no more
    std::function<std::uint64_t(std::uint32_t)> weight;         // how much work a task is; only ratios count
    std::function<std::vector<std::byte>(std::uint32_t)> input; // called from any thread

    /// Gets each task's result, one at a time, in any order.
    std::function<void(std::uint32_t, std::span<const std::byte>)> take;
};

/// Does one task: from its input to its result.
using Perform = std::function<std::vector<std::byte>(TaskKind, std::span<const std::byte>)>;

/// Where tasks run: in the threads of this process, or in those of many.
class TaskRunner {
public:
    TaskRunner() = default;
    virtual ~TaskRunner() = default;
    TaskRunner(const TaskRunner&) = delete;
    TaskRunner& operator=(const TaskRunner&) = delete;
    TaskRunner(TaskRunner&&) = delete;
    TaskRunner& operator=(TaskRunner&&) = delete;

    /// Runs all tasks of `phase`; this process does its own by `perform`. Throws what a task throws.
    virtual void run(const TaskPhase& phase, const Perform& perform) = 0;
};

/// In the threads of this process, tasks in their order.
class LocalTasks final : public TaskRunner {
public:
    void run(const TaskPhase& phase, const Perform& perform) override;
};

using scratch::Blocks;

/// Blocks of the scratch file for streams, by number.
using Mail = std::vector<std::pair<std::uint32_t, scratch::Block>>;

/// A number of things of which each has a byte or more. Throws hierarchy::Damage.
std::size_t takeCount(hierarchy::ByteReader& in);

void putBlocks(hierarchy::ByteWriter& out, const Blocks& blocks);
Blocks takeBlocks(hierarchy::ByteReader& in);

void putMail(hierarchy::ByteWriter& out, const Mail& mail);
Mail takeMail(hierarchy::ByteReader& in);

} // namespace gnomon::pipeline
