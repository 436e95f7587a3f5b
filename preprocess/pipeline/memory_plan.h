// How a build divides the memory that it was promised.
#pragma once

#include "core/units.h"
#include "preprocess/chunk/chunk_streams.h"
#include "preprocess/chunk/chunk_tree.h"
#include "preprocess/read/mesh_source.h"

#include <cstddef>

namespace gnomon::pipeline {

/// What the parts of a build take at their peak: estimates from above, within a quarter of the
/// peak of ordinary models (tests/cli/memory_test.py).
struct MemoryNeeds {
    const read::MeshSummary& source;
    std::uint32_t chunkTriangles = 0;
    bool isInMemory = false; // temporary files in memory, too
    bool isSerial = false;   // sorted in whole passes, though the source has ranges
    std::size_t threads = 1;

    /// What the process takes before it works, and what the source itself holds.
    Bytes base() const;

    /// What working on a node takes.
    static Bytes node(const chunk::PartSize& size, std::size_t threads = 1);

    /// What finding the answers of a chunk for others takes; at most what a node of its size does.
    static Bytes borders(const chunk::PartSize& size);

    /// What handing on the clusters that a node left takes: `bytes` of them, with `vertices`; less than a node of their
    /// size.
    static Bytes routing(std::uint64_t bytes, std::uint64_t vertices);

    /// What a task of a range of rows takes at least, and how much of that for tables and the blocks of streams.
    static Bytes rangeTask(const read::MeshSummary& source);
    static Bytes leastRangeTables(const read::MeshSummary& source);

    /// What sorting by ranges takes beside its tasks.
    Bytes ranges() const;

    /// The first look at the source.
    Bytes survey() const;

    /// Sorting the source into chunks, without the streams' blocks.
    Bytes binning() const;

    /// What all takes until the source is in chunks: the header tells it.
    Bytes sorting() const;

    /// What all takes from there on, once the largest chunk is known.
    Bytes building(const chunk::PartSize& largest) const;

    /// The memory that builds the source in any case, as far as its header tells: chunks may turn out to need less.
    Bytes most() const;
};

/// The size of the streams' blocks when `streams` are written side by side in `room`.
std::size_t blockBytes(Bytes room, std::uint64_t streams);

/// How many pieces of work that take `each` fit into `room` at once; 0 if none does. At most one more than `threads`.
std::size_t countAtOnce(Bytes room, Bytes each, std::size_t threads);

} // namespace gnomon::pipeline
