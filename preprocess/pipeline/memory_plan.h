// Divides the memory limit of a build between its phases and tasks.
#pragma once

#include "core/units.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/read/mesh_source.h"

#include <cstddef>

namespace gnomon::pipeline {

/// Upper estimates of the peak memory of the parts of a build. They are within a quarter of the measured peak for
/// ordinary models (tests/cli/memory_test.py).
struct MemoryNeeds {
    const read::MeshSummary& source;
    std::uint32_t chunkTriangles = 0;
    bool isInMemory = false; // temporary files also in memory
    bool isSerial = false;   // sorted in whole passes, although the source supports ranges
    std::size_t threads = 1;

    /// Returns the memory of the idle process and of the source itself.
    Bytes base() const;

    /// Returns the memory of a task that builds a node.
    static Bytes node(const chunk::PartSize& size, std::size_t threads = 1);

    /// Returns the memory of a task that computes the border answers of a chunk. It is at most the memory of a node of
    /// this size.
    static Bytes borders(const chunk::PartSize& size);

    /// Returns the memory of a task that routes `bytes` of clusters with `vertices` vertices. It is less than the
    /// memory of a node of this size.
    static Bytes routing(std::uint64_t bytes, std::uint64_t vertices);

    /// Return the min memory of a task over a range of rows, and the part of it for tables and stream blocks.
    static Bytes rangeTask(const read::MeshSummary& source);
    static Bytes minRangeTables(const read::MeshSummary& source);

    /// Returns the memory for sorting by ranges, without its tasks.
    Bytes ranges() const;

    /// Returns the memory of the survey.
    Bytes survey() const;

    /// Returns the memory for binning the source, without stream blocks.
    Bytes binning() const;

    /// Returns the memory of all phases until the source is in chunks. It depends only on the header.
    Bytes sorting() const;

    /// Returns the memory of all later phases, given the largest chunk.
    Bytes building(const chunk::PartSize& largest) const;

    /// Returns a memory that is always sufficient, computed from the header. The chunks may need less.
    Bytes peak() const;
};

/// Returns the block size for `streams` streams that are written at the same time in `room`.
std::size_t blockBytes(Bytes room, std::uint64_t streams);

/// Returns the number of tasks of size `each` that fit into `room` at once, at most `threads` + 1. Returns 0 if none
/// fits.
std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads);

} // namespace gnomon::pipeline
