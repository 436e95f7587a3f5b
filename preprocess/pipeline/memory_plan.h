// Divides the memory limit of a build among its phases and tasks.
#pragma once

#include "core/units.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/read/mesh_source.h"

#include <cstddef>

namespace gnomon::pipeline {

/// Upper estimates of the peak memory of the phases and tasks of a build. For ordinary models they are within a quarter
/// of the measured peak (tests/cli/memory_test.py).
struct MemoryNeeds {
    const read::MeshSummary& source;
    std::uint32_t chunkTriangles = 0;
    bool isInMemory = false; // whether temporary files are in memory too
    bool isSerial = false;   // whether the source is sorted in whole passes, although it supports ranges
    std::size_t threads = 1;

    /// Returns the memory of the idle process plus the memory of the source itself.
    Bytes base() const;

    /// Returns the memory of a task that builds a node.
    static Bytes node(const chunk::PartSize& size, std::size_t threads = 1);

    /// Returns the memory of a task that computes which vertices and normals a chunk sends to other chunks. It is at
    /// most the memory of a node of this size.
    static Bytes borders(const chunk::PartSize& size);

    /// Returns the memory of a task that routes clusters of `bytes` bytes with `vertices` vertices to the next round.
    /// It is less than the memory of a node of this size.
    static Bytes routing(std::uint64_t bytes, std::uint64_t vertices);

    /// Return the min memory of a task that sorts a range of rows, and the share of this memory for tables and stream
    /// blocks.
    static Bytes rangeTask(const read::MeshSummary& source);
    static Bytes minRangeTables(const read::MeshSummary& source);

    /// Returns the memory for sorting the source by ranges, without the memory of the tasks.
    Bytes ranges() const;

    /// Returns the memory of the survey in whole passes.
    Bytes survey() const;

    /// Returns the memory for binning the source in whole passes, without stream blocks.
    Bytes binning() const;

    /// Returns the memory of all phases until the source is in chunks. It depends only on the source's header.
    Bytes sorting() const;

    /// Returns the memory of all phases after the sorting. `largest` is the largest chunk.
    Bytes building(const chunk::PartSize& largest) const;

    /// Returns an amount of memory that is always sufficient. It is computed from the source's header. The actual
    /// chunks may need less.
    Bytes peak() const;
};

/// Returns the block size for `streams` streams that are written at the same time. Their blocks use the memory `room`.
std::size_t blockBytes(Bytes room, std::uint64_t streams);

/// Returns how many tasks of memory `each` fit into `room` at the same time, at most `threads` + 1. Returns 0 if none
/// fits.
std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads);

} // namespace gnomon::pipeline
