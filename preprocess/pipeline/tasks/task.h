// The tasks of a build. Any process can run them. Each task is a pure function of its input and of data in scratch
// files.
#pragma once

#include "hierarchy/bytes.h"
#include "preprocess/scratch/stream_store.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::pipeline {

/// The kinds of tasks, in the order of a build.
enum class TaskKind : std::uint8_t {
    CountFaces,      // of a range of the source: counts corners per vertex and samples edges
    MeasureVertices, // of a range of vertices: sums the corner counts and measures the bounds
    CountCells,      // of a range of vertices: counts weights in the cells of the octree
    BinVertices,     // of a range of vertices: sorts them into chunks
    BinFaces,        // of a range of faces: sorts them into chunks
    AnswerVertices,  // of a chunk: returns vertices that other chunks requested
    AnswerNormals,   // of a chunk: returns normals that other chunks requested
    BuildNode,       // builds a chunk, or a node of a later round
    RouteClusters,   // of a node: routes its clusters to nodes of the next round
    ShareLocks,      // of a border stream: finds positions that several nodes of the next round use
    WritePages,      // writes a range of consecutive pages to the model file
};

/// A set of independent tasks.
struct TaskPhase {
    TaskKind kind = TaskKind::BuildNode;
    std::vector<std::uint32_t> tasks;                   // task numbers, ascending
    std::size_t atOnce = 1;                             // max concurrent tasks per process, limited by its memory
    std::function<std::uint64_t(std::uint32_t)> weight; // relative amount of work of a task
    std::function<std::vector<std::byte>(std::uint32_t)> input; // returns the input of a task; called from any thread

    /// Receives the result of each task, one at a time, in any order.
    std::function<void(std::uint32_t, std::span<const std::byte>)> take;
};

/// Runs one task: returns the result for an input.
using Perform = std::function<std::vector<std::byte>(TaskKind, std::span<const std::byte>)>;

/// The interface that runs tasks in the threads of one or many processes.
class TaskRunner {
public:
    TaskRunner() = default;
    virtual ~TaskRunner() = default;
    TaskRunner(const TaskRunner&) = delete;
    TaskRunner& operator=(const TaskRunner&) = delete;
    TaskRunner(TaskRunner&&) = delete;
    TaskRunner& operator=(TaskRunner&&) = delete;

    /// Runs all tasks of `phase`. This process runs its own tasks with `perform`. Throws the error of a failed task.
    virtual void run(const TaskPhase& phase, const Perform& perform) = 0;
};

/// Runs tasks in the threads of this process, in order.
class LocalTasks final : public TaskRunner {
public:
    void run(const TaskPhase& phase, const Perform& perform) override;
};

using scratch::Blocks;

/// Blocks of the scratch file with the streams that receive them.
using Mail = std::vector<std::pair<std::uint32_t, scratch::Block>>;

/// Reads a number of elements that have at least one byte each. Throws hierarchy::Damage if there are not enough bytes.
std::size_t takeCount(hierarchy::ByteReader& in);

/// Encode and decode lists of blocks. Decoding throws hierarchy::Damage if the bytes are malformed.
void putBlocks(hierarchy::ByteWriter& out, const Blocks& blocks);
Blocks takeBlocks(hierarchy::ByteReader& in);

/// Encode and decode mail. Decoding throws hierarchy::Damage if the bytes are malformed.
void putMail(hierarchy::ByteWriter& out, const Mail& mail);
Mail takeMail(hierarchy::ByteReader& in);

} // namespace gnomon::pipeline
