// The tasks of a build, which any process of a distributed build can run. The result of a task depends only on its
// input and on data in scratch files.
#pragma once

#include "hierarchy/bytes.h"
#include "preprocess/scratch/stream_store.h"

#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::pipeline {

/// The kinds of build tasks, in the order in which a build runs them.
enum class TaskKind : std::uint8_t {
    CountFaces,      // for a range of faces: counts corners per vertex and samples edges
    MeasureVertices, // for a range of vertices: adds up the corner counts and measures the bounds
    CountCells,      // for a range of vertices: counts the weights of octree cells
    BinVertices,     // for a range of vertices: sorts the vertices into chunks
    BinFaces,        // for a range of faces: sorts the faces into chunks
    AnswerVertices,  // for a chunk: returns the vertices that other chunks requested
    AnswerNormals,   // for a chunk: returns the normals of vertices that other chunks use
    BuildNode,       // for a chunk or a node of a later round: builds its levels of detail
    RouteClusters,   // for a node: sends its clusters to nodes of the next round
    ShareLocks,      // for a border stream: finds positions that several nodes of the next round share
    WritePages,      // for a range of consecutive pages: writes the pages to the model file
};

/// A set of independent build tasks of one kind.
struct TaskPhase {
    TaskKind kind = TaskKind::BuildNode;
    std::vector<std::uint32_t> tasks; // task numbers, ascending
    // Max number of tasks that a process can run at the same time with its memory.
    std::size_t atOnce = 1;
    std::function<std::uint64_t(std::uint32_t)> weight;         // returns the relative amount of work of a task
    std::function<std::vector<std::byte>(std::uint32_t)> input; // returns the input of a task; called from any thread

    /// This function is called with each task number and its result, one call at a time, in any order.
    std::function<void(std::uint32_t, std::span<const std::byte>)> take;
};

/// A function that runs one build task of the given kind with the given input, and returns its result.
using Perform = std::function<std::vector<std::byte>(TaskKind, std::span<const std::byte>)>;

/// The interface that runs build tasks in the threads of one or several processes.
class TaskRunner {
public:
    TaskRunner() = default;
    virtual ~TaskRunner() = default;
    TaskRunner(const TaskRunner&) = delete;
    TaskRunner& operator=(const TaskRunner&) = delete;
    TaskRunner(TaskRunner&&) = delete;
    TaskRunner& operator=(TaskRunner&&) = delete;

    /// Runs all tasks of `phase`. This process calls `perform` for its tasks. Throws the error of a failed task.
    virtual void run(const TaskPhase& phase, const Perform& perform) = 0;
};

/// Runs build tasks in the threads of this process, and passes on their results in order.
class LocalTasks final : public TaskRunner {
public:
    void run(const TaskPhase& phase, const Perform& perform) override;
};

using scratch::Blocks;

/// Blocks of the scratch file, each with the number of the stream to which the block belongs.
using Mail = std::vector<std::pair<std::uint32_t, scratch::Block>>;

/// Decodes the number of elements of a list in which each element has at least one byte. Throws hierarchy::Damage if
/// fewer bytes are left.
std::size_t takeCount(hierarchy::ByteReader& in);

/// Encodes and decodes lists of scratch file blocks. Decoding throws hierarchy::Damage if the bytes are malformed.
void putBlocks(hierarchy::ByteWriter& out, const Blocks& blocks);
Blocks takeBlocks(hierarchy::ByteReader& in);

/// Encodes and decodes lists of blocks with stream numbers. Decoding throws hierarchy::Damage if the bytes are
/// malformed.
void putMail(hierarchy::ByteWriter& out, const Mail& mail);
Mail takeMail(hierarchy::ByteReader& in);

} // namespace gnomon::pipeline
