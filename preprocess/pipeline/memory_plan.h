// Divides the memory limit of a build between its phases and parallel tasks.
#pragma once

#include "core/units.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/read/mesh_source.h"

#include <cstddef>

namespace gnomon::pipeline {

/// Estimates the peak memory of the phases and tasks of a build from above. For ordinary models the estimates are
/// within a quarter of the measured peak (tests/cli/memory_test.py).
struct MemoryNeeds {
    const read::MeshSummary& source;
    std::uint32_t chunkTriangles = 0;
    bool isInMemory = false; // whether temporary files are in memory too
    bool isSerial = false;   // whether the source is sorted in passes over the whole file, not by ranges
    std::size_t threads = 1;

    /// Returns the memory of the idle process plus the memory of the opened source.
    Bytes base() const;

    /// Returns the memory of a task that builds one node, a part of the model of size `size`.
    static Bytes node(const chunk::PartSize& size, std::size_t threads = 1);

    /// Returns the memory of a task that computes which vertices and normals a chunk of size `size` sends to other
    /// chunks. It is at most the memory of a node of this size.
    static Bytes borders(const chunk::PartSize& size);

    /// Returns the memory of a task that sends clusters to the nodes of the next round. The clusters have `bytes` bytes
    /// and `vertices` vertices in total. The result is less than the memory of a node of this size.
    static Bytes routing(std::uint64_t bytes, std::uint64_t vertices);

    /// Return the min memory of a task that sorts a range of source rows, and the share of this memory for tables and
    /// stream blocks.
    static Bytes rangeTask(const read::MeshSummary& source);
    static Bytes minRangeTables(const read::MeshSummary& source);

    /// Returns the memory for sorting the source by parallel tasks, one per range of rows. The memory of the tasks is
    /// excluded.
    Bytes ranges() const;

    /// Returns the memory of the measurement of the source (survey) in passes over the whole file.
    Bytes survey() const;

    /// Returns the memory for sorting the source into chunks in passes over the whole file, without stream blocks.
    Bytes binning() const;

    /// Returns the memory of all phases until the source is sorted into chunks. It depends only on the source's header.
    Bytes sorting() const;

    /// Returns the memory of all phases after the source is sorted into chunks. `largest` is the size of the largest
    /// chunk.
    Bytes building(const chunk::PartSize& largest) const;

    /// Returns an amount of memory that is sufficient for each build of this source. It is computed from the source's
    /// header. The actual chunks may need less.
    Bytes peak() const;
};

/// Returns the block size in bytes for `streams` streams that are written at the same time. Together their blocks use
/// the memory `room`.
std::size_t blockBytes(Bytes room, std::uint64_t streams);

/// Returns how many parallel tasks fit into the memory `room` if each task needs `each`. The result is at most
/// `threads` + 1. It is 0 if no task fits.
std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads);

} // namespace gnomon::pipeline
